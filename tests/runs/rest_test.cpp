/// Whole runs of the three styles after the character has stopped: what a user sees with
/// `mane simulate scenes/X.toml --set motion.freeze=3` and `mane check`.

#include "whole_run.h"

using namespace mane;

namespace {

/// Simulates a style that stops at 3 s, and judges it. Strands rest as their wisps do, so few are
/// drawn.
CheckReport stopped(const std::string& style) {
    CheckReport report = simulate_and_check(style, "--set motion.freeze=3", 10);
    for (const char* name : {"rest_speed", "still_speed", "rest_jitter"}) {
        const Criterion& c = report[name];
        MESSAGE(style << ": " << c.name << " " << 1e3 * c.value << " mm/s, bound "
                      << 1e3 * c.bound);
    }
    return report;
}

} // namespace

TEST_CASE("short and long come to rest") {
    for (const char* style : {"short", "long"}) {
        const CheckReport report = stopped(style);
        CAPTURE(style);
        for (const char* name : {"rest_speed", "still_speed", "rest_jitter"}) {
            CAPTURE(name);
            CHECK(report[name].verdict == Verdict::pass);
        }
    }
}

// Some wisps of `medium` creep down neck and shoulders for longer than this, at about 1 mm/s, and
// an envelope point jerks by a few tenths of a millimetre where its wisp slides over a hollow of
// the skin: the judge's two bounds of 1 mm/s, which are unchanged, are missed (docs/results.md).
// This holds the figures where they are; hair that keeps shaking is far above them.
TEST_CASE("medium comes to rest, but for a creep") {
    const CheckReport report = stopped("medium");
    CHECK(report["rest_speed"].verdict == Verdict::pass);
    for (const char* name : {"still_speed", "rest_jitter"}) {
        CAPTURE(name);
        CHECK(report[name].bound == 0.001);
        CHECK(report[name].value <= 0.004);
    }
}
