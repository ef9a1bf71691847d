/// Every style on every captured clip, whole, with the scene as it is: what `scripts/evidence.py`
/// reports of the paper's interactions, judged.

#include "../formats/clip_data.h"
#include "whole_run.h"

#include <toml++/toml.h>

#include <algorithm>
#include <string>

using namespace mane;

namespace {

constexpr double kFrameRate = 30;
constexpr int kMostFrames = 264;

/// The settings that put a clip of scripts/clips.toml under a scene.
std::string settings(const toml::table& clip, const std::string& file) {
    const auto number = [&](const char* key) { return clip[key].value<double>().value(); };
    const double seconds = (number("last") - number("first")) / number("fps");
    const int frames = std::min(kMostFrames, static_cast<int>(seconds * kFrameRate + 1e-6) + 1);
    std::string text = " --set 'motion.clip=" + file + "' --set schedule.frame_rate=30";
    text += " --set schedule.frames=" + std::to_string(frames);
    for (const char* key : {"unit", "fps", "lowpass"})
        text += " --set motion." + std::string(key) + "=" + std::to_string(number(key));
    for (const char* key : {"earliest", "first"})
        text += " --set motion." + std::string(key) + "=" +
                std::to_string(static_cast<long>(number(key)));
    // drawn so, strands have the least room in their envelopes (M17)
    return text + " --set strands.waves=5 --set strands.wave_amplitude=0.2 --set strands.curls=2";
}

/// Simulates and judges one cell of the matrix.
void judge(const std::string& style, const toml::table& clip) {
    const std::string data = shared_data("mocap/" + clip["file"].value<std::string>().value());
    if (data.empty())
        return;
    const CheckReport report = simulate_and_check(style, settings(clip, data), 2000);
    CHECK(report.passed());
    for (const Criterion& c : report.criteria)
        if (c.verdict == Verdict::fail)
            MESSAGE(c.name << " is " << c.value << ", bound " << c.bound);
}

void judge_all(const std::string& style) {
    const toml::table file = toml::parse_file(MANE_SOURCE_DIR "/scripts/clips.toml");
    const toml::array& clips = *file["clip"].as_array();
    CHECK(clips.size() == 9);
    for (const toml::node& clip : clips) {
        CAPTURE(style);
        CAPTURE((*clip.as_table())["name"].value<std::string>().value());
        judge(style, *clip.as_table());
    }
}

} // namespace

TEST_CASE("short on nine clips passes mane check") {
    judge_all("short");
}
TEST_CASE("medium on nine clips passes mane check") {
    judge_all("medium");
}
TEST_CASE("long on nine clips passes mane check") {
    judge_all("long");
}
