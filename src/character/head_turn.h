#pragma once

#include "character/rotation.h"
#include "mane/character.h"

namespace mane {

// Angles and how fast they change.
struct HeadTurnMotion {
    HeadTurn angle; // [rad]
    HeadTurn rate;  // [rad/s]
};

// Yaw, then pitch inside it, then roll inside both.
Turning turning_of(const HeadTurnMotion& turn);

// The three bones' turning when the body turns so and the head on it so; the neck follows with half
// of the head's angles.
std::array<Turning, kBustBones> bust_turning(const HeadTurnMotion& body,
                                             const HeadTurnMotion& head);

} // namespace mane
