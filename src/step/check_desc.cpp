#include "step/check_desc.h"

#include "mane/error.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

// Wider than the ranges of the table of fields, which say what makes sense: here is what a step
// needs. Rates are the schedule's to check.

[[noreturn]] void refuse(const std::string& key, double found, const std::string& expected) {
    throw InputError(key + ": found " + std::to_string(found) + ", expected " + expected);
}

void expect_finite(const char* key, const Vec3& v) {
    for (float x : {v.x, v.y, v.z})
        if (!std::isfinite(x))
            refuse(key, double{x}, "three finite numbers");
}

void expect_at_least(const char* key, float x, float least) {
    if (!(x >= least) || std::isinf(x))
        refuse(key, double{x}, "a number of at least " + std::to_string(least));
}

void expect_angle(const char* key, float degrees) {
    if (!(degrees >= 0 && degrees <= 90))
        refuse(key, double{degrees}, "0 to 90 degrees");
}

void expect_not_above(const char* low_key, float low, const char* high_key, float high) {
    if (low > high)
        refuse(low_key, double{low},
               "at most " + std::string(high_key) + " = " + std::to_string(high));
}

void check(const AirDesc& air) {
    expect_at_least("air.drag", air.drag, 0);
    expect_finite("air.wind", air.wind);
    expect_at_least("air.gusts", air.gusts, 0);
    if (!(air.gust_size > 0) || std::isinf(air.gust_size))
        refuse("air.gust_size", double{air.gust_size}, "a number over 0");
}

void check(const WispContactDesc& wisps) {
    expect_angle("wisps.parallel_angle", wisps.parallel_angle);
    expect_angle("wisps.fade_angle", wisps.fade_angle);
    expect_not_above("wisps.fade_angle", wisps.fade_angle, "wisps.parallel_angle",
                     wisps.parallel_angle);
    expect_at_least("wisps.sliding_speed", wisps.sliding_speed, 0);
    expect_at_least("wisps.hysteresis", wisps.hysteresis, 1);
    expect_at_least("wisps.friction", wisps.friction, 0);
    expect_at_least("wisps.axis_contact_ratio", wisps.axis_contact_ratio, 0);
}

void check(const CharacterContactDesc& character) {
    expect_at_least("character.threshold", character.threshold, 0);
    expect_at_least("character.push_out", character.push_out, 0);
    expect_not_above("character.push_out", character.push_out, "character.threshold",
                     character.threshold);
    expect_at_least("character.friction", character.friction, 0);
}

template <typename T> void expect_same(const char* key, T now, T next) {
    if (next != now)
        refuse(key, static_cast<double>(next),
               std::to_string(now) + ": it is fixed while a world runs");
}

} // namespace

void check_desc(const SimulationDesc& desc) {
    expect_finite("simulation.gravity", desc.gravity);
    check(desc.air);
    check(desc.wisps);
    check(desc.character);
}

void check_fixed(const SimulationDesc& now, const SimulationDesc& next) {
    expect_same("simulation.seed", now.seed, next.seed);
    expect_same("schedule.frames", now.schedule.frames, next.schedule.frames);
    expect_same("schedule.preroll", now.schedule.preroll, next.schedule.preroll);
}

} // namespace mane
