#pragma once

#include "mane/driven.h"

#include <array>
#include <memory>

namespace mane::page {

/// How a hand holds the head: how far from where its motion has it, and how it is turned there.
struct Hold {
    Vec3d position; ///< [m]
    HeadTurn turn;  ///< [rad] yaw about the vertical; the shoulders come along with a part of it
};

/// Leads the character: along a motion that can be changed for another, as a hand holds it there.
/// Until someone asks for anything, its motion is the scene's own, bit for bit.
class Lead {
  public:
    /// `motion` may be null: at rest. A motion of `length` [s] over 0 begins again after that.
    Lead(std::shared_ptr<const Motion> motion, double length);

    /// The same from the beginning, with a hand that holds nothing.
    void begin(std::shared_ptr<const Motion> motion, double length);

    /// What the world's first body moves by.
    std::shared_ptr<const Motion> motion() const;
    /// From now on, softly.
    void hold(const Hold& hold);
    /// From `time` on another motion, from its beginning. The head turns over to it within a
    /// second; the place where it is then is the new motion's beginning.
    void follow(std::shared_ptr<const Motion> motion, double length, double time);
    /// Puts the character elsewhere, as it moves: `World::teleport` is to follow.
    void jump(const Vec3d& by, double time);
    /// Before each frame: leads from `from` to `to` [s].
    void advance(double from, double to);

  private:
    class Switch;
    struct Path { ///< a motion, where and when it is played
        std::shared_ptr<const Motion> motion;
        double length = 0, begin = 0;
        Vec3d shift;
        HeadPose at(double time) const;
    };
    HeadPose pose(double time) const;
    void take_over(double time);

    std::shared_ptr<Switch> switch_;
    Path path_, before_;
    double changed_ = 0;                          ///< [s] when `before_` became `path_`
    Hold wanted_;                                 ///< what was asked for
    std::array<double, 6> held_{}, velocities_{}; ///< what of it is reached
    double frame_ = 1.0 / 24;                     ///< [s]
};

} // namespace mane::page
