/// Styles on captured clips, whole, with the scene as it is: what `scripts/evidence.py` reports of
/// the paper's interactions, judged. Every clip with `long`, three with each of the other styles;
/// all of them with MANE_ALL_CLIPS=1, in some four minutes.

#include "../formats/clip_data.h"
#include "whole_run.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
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

/// The clips whose number leaves `rest` by `every`; all with MANE_ALL_CLIPS in the environment.
void judge_clips(const std::string& style, std::size_t every, std::size_t rest) {
    const toml::table file = toml::parse_file(MANE_SOURCE_DIR "/scripts/clips.toml");
    const toml::array& clips = *file["clip"].as_array();
    CHECK(clips.size() == 9);
    for (std::size_t i = 0; i < clips.size(); ++i) {
        if (i % every != rest && !std::getenv("MANE_ALL_CLIPS"))
            continue;
        const toml::table& clip = *clips[i].as_table();
        CAPTURE(style);
        CAPTURE(clip["name"].value<std::string>().value());
        judge(style, clip);
    }
}

} // namespace

TEST_CASE("short on three clips passes mane check") {
    judge_clips("short", 3, 0);
}
TEST_CASE("medium on three other clips passes mane check") {
    judge_clips("medium", 3, 1);
}
TEST_CASE("long on nine clips passes mane check") {
    judge_clips("long", 1, 0);
}
