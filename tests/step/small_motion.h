#pragma once

#include "mane/frame.h"
#include "mane/groom.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace mane {

/// The quadratic forms of small sideways motion, over sections 2 … n of one hanging wisp.
class SmallMotion {
  public:
    explicit SmallMotion(const Groom& groom) : groom_(groom), size_(groom.section_count() - 2) {
        stiffness_.assign(size_, Vector(size_, 0.0));
        const std::size_t tip = groom.section_count() - 1;
        double below = 0;
        for (std::size_t i = tip - 1; i >= 1; --i) { // strings under tension
            below += mass(i + 1);
            const double l = segment(i);
            add(stiffness_, {{i + 1, 1 / l}, {i, -1 / l}}, below * 9.81 * l);
        }
        for (std::size_t i = 1; i < tip; ++i)
            add(stiffness_, bend(i), double{groom.bend_stiffness[i]});
        find_first_mode();
    }

    double frequency() const { return frequency_; }
    /// φᵀMx: how much of the first mode is in a frame's motion along x. Other modes are none of it.
    double first_mode(const Frame& frame) const {
        double sum = 0;
        for (std::size_t i = 2; i < groom_.section_count(); ++i)
            sum += mass(i) * at(i) * double{frame.position[i].x - frame.position[1].x};
        return sum;
    }
    /// The bending dampers' share in γ [1/s].
    double bending_decay() const {
        double lost = 0;
        for (std::size_t i = 1; i + 1 < groom_.section_count(); ++i) {
            double rate = 0;
            for (const Term& term : bend(i))
                rate += term.weight * at(term.section);
            lost += double{groom_.bend_damping[i]} * rate * rate;
        }
        return lost / (2 * modal_mass());
    }

  private:
    using Vector = std::vector<double>;
    using Matrix = std::vector<Vector>;
    struct Term {
        std::size_t section;
        double weight;
    };

    double mass(std::size_t i) const {
        return double{groom_.skeleton_mass[i]} +
               groom_.envelope_points * double{groom_.envelope_mass[i]};
    }
    double segment(std::size_t i) const {
        return length(Vec3d(groom_.position[i + 1]) - Vec3d(groom_.position[i]));
    }
    std::vector<Term> bend(std::size_t i) const {
        const double after = 1 / segment(i), before = 1 / segment(i - 1);
        return {{i + 1, after}, {i, -after - before}, {i - 1, before}};
    }
    double at(std::size_t section) const { return section < 2 ? 0 : mode_[section - 2]; }

    /// Adds ½ `factor` (Σ weight x)²; sections 0 and 1 do not move.
    void add(Matrix& form, const std::vector<Term>& terms, double factor) const {
        for (const Term& a : terms)
            for (const Term& b : terms)
                if (a.section >= 2 && b.section >= 2)
                    form[a.section - 2][b.section - 2] += factor * a.weight * b.weight;
    }

    double modal_mass() const {
        double sum = 0;
        for (std::size_t i = 2; i < groom_.section_count(); ++i)
            sum += mass(i) * at(i) * at(i);
        return sum;
    }

    /// Inverse iteration: x ← K⁻¹Mx turns to the slowest mode.
    void find_first_mode() {
        mode_.assign(size_, 1.0);
        for (int i = 0; i < 50; ++i) {
            Vector load(size_);
            for (std::size_t j = 0; j < size_; ++j)
                load[j] = mass(j + 2) * mode_[j];
            const Vector next = solve(stiffness_, load);
            frequency_ = std::sqrt(mode_.back() / next.back());
            for (std::size_t j = 0; j < size_; ++j)
                mode_[j] = next[j] / next.back();
        }
    }

    /// Gauss elimination; K is positive definite.
    static Vector solve(Matrix a, Vector b) {
        const std::size_t n = b.size();
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t r = p + 1; r < n; ++r) {
                const double f = a[r][p] / a[p][p];
                for (std::size_t c = p; c < n; ++c)
                    a[r][c] -= f * a[p][c];
                b[r] -= f * b[p];
            }
        for (std::size_t p = n; p-- > 0;) {
            for (std::size_t c = p + 1; c < n; ++c)
                b[p] -= a[p][c] * b[c];
            b[p] /= a[p][p];
        }
        return b;
    }

    const Groom& groom_;
    std::size_t size_;
    Matrix stiffness_;
    Vector mode_;
    double frequency_ = 0;
};

} // namespace mane
