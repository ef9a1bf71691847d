#pragma once

#include "groom/bend.h"
#include "groom/shape.h"

#include <cmath>

namespace mane {

/// What a joint does to the two segments beside it: its bending spring, and the twist of rest bends
/// (docs/model.md, "Bending", "Twist"). `off_rest`, a vector in the section, is κ − κ⁰ times the
/// joint's stiffness [N·m]; all is linear in it.
class Joint {
  public:
    /// Joint i of a shape, between segments i − 1 and i.
    Joint(const Shape& s, std::size_t i)
        : before_(s.tangent[i - 1]), after_(s.tangent[i]), normal_(s.normal[i]), u_(s.u[i]),
          v_(s.v[i]), bend_(bend_between(before_, after_)),
          carried_(holonomy_gradient(s.normal[i - 1], s.normal[i])),
          carried_after_(holonomy_gradient(s.normal[i], s.normal[i + 1])) {}

    /// κ [rad], across the section's normal.
    Vec3d curvature() const { return bend_.w * bend_.g; }
    /// κ − κ⁰ [rad] for a rest curvature with these components.
    Vec3d off_rest(double rest_u, double rest_v) const {
        return u_ * (bend_.g * dot(bend_.w, u_) - rest_u) +
               v_ * (bend_.g * dot(bend_.w, v_) - rest_v);
    }
    /// The twist moment that the joint hands on toward the root.
    double twist(const Vec3d& off_rest) const {
        const Vec3d kappa = curvature();
        return dot(off_rest, u_) * dot(kappa, v_) - dot(off_rest, v_) * dot(kappa, u_);
    }

    /// The moment that works against a turn of the segment before or after: of the joint's own
    /// spring and twist.
    Vec3d on_before(const Vec3d& off_rest) const { return own(off_rest, before_, -1); }
    Vec3d on_after(const Vec3d& off_rest) const { return own(off_rest, after_, 1); }
    /// The same of the twist that later joints hand on through this one.
    Vec3d handed_on_before(double twist) const { return handed_on(twist, before_); }
    Vec3d handed_on_after(double twist) const { return handed_on(twist, after_); }

    /// The `off_rest` with which `on_after` is `wanted`: two equations, for its two components.
    Vec3d solve_after(const Vec3d& wanted) const {
        const Vec3d a = on_after(u_), b = on_after(v_);
        const double determinant = dot(cross(a, b), after_);
        return u_ * (dot(cross(wanted, b), after_) / determinant) +
               v_ * (dot(cross(a, wanted), after_) / determinant);
    }

  private:
    Vec3d own(const Vec3d& off_rest, const Vec3d& segment, double side) const {
        const double twist_here = twist(off_rest);
        return across(cross(normal_, bend_map(bend_, off_rest)) * side -
                          normal_ * (twist_here / 2) + turning(carried_ * twist_here, segment),
                      segment);
    }
    Vec3d handed_on(double twist, const Vec3d& segment) const {
        return across(turning((carried_ + carried_after_) * twist, segment), segment);
    }
    static Vec3d across(const Vec3d& x, const Vec3d& segment) {
        return x - segment * dot(x, segment);
    }
    /// The moment of a slope by the normal, on a segment that turns the normal half as much as
    /// itself.
    Vec3d turning(const Vec3d& slope, const Vec3d& segment) const {
        return cross(slope, segment) / (2 * std::fmax(dot(normal_, segment), kLeastHalfCosine));
    }

    Vec3d before_, after_, normal_, u_, v_;
    Bend bend_;
    Vec3d carried_, carried_after_;
};

} // namespace mane
