#pragma once

#include "mane/vec.h"

namespace mane::reference {

/// A 3×3 matrix by its rows.
struct Matrix3 {
    Vec3d row[3];

    static Matrix3 scale(double s) { return {{{s, 0, 0}, {0, s, 0}, {0, 0, s}}}; }
    /// a bᵀ
    static Matrix3 outer(const Vec3d& a, const Vec3d& b) { return {{a.x * b, a.y * b, a.z * b}}; }

    Matrix3& operator+=(const Matrix3& o) {
        for (int i = 0; i < 3; ++i)
            row[i] += o.row[i];
        return *this;
    }
    friend Matrix3 operator+(Matrix3 a, const Matrix3& b) { return a += b; }
    friend Matrix3 operator-(const Matrix3& a, const Matrix3& b) { return a + (-1.0) * b; }
    friend Matrix3 operator*(double s, const Matrix3& m) {
        return {{s * m.row[0], s * m.row[1], s * m.row[2]}};
    }
    friend Vec3d operator*(const Matrix3& m, const Vec3d& v) {
        return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
    }
    double trace() const { return row[0].x + row[1].y + row[2].z; }

    /// By Cramer's rule.
    Matrix3 inverse() const {
        const Vec3d a = cross(row[1], row[2]), b = cross(row[2], row[0]), c = cross(row[0], row[1]);
        const double determinant = dot(row[0], a);
        return (1 / determinant) * Matrix3{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}};
    }
};

} // namespace mane::reference
