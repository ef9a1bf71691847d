#pragma once

#include "mane/cache.h"
#include "mane/check.h"
#include "mane/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mane::test {

/// A run as a test wants it: frames in memory that anything can be done to before they are judged.
struct SyntheticRun {
    SceneDesc scene;
    RunSetup setup; ///< its scene is written from `scene` when judged
    std::vector<Frame> frames;
    std::vector<BodyPoses> poses;
    std::string statistics;

    std::size_t section(std::size_t wisp, std::size_t i) const {
        return setup.groom.first_section[wisp] + i;
    }
    Vec3& position(std::size_t frame, std::size_t wisp, std::size_t i) {
        return frames[frame].position[section(wisp, i)];
    }
    Vec3& velocity(std::size_t frame, std::size_t wisp, std::size_t i) {
        return frames[frame].velocity[section(wisp, i)];
    }
    float& radius(std::size_t frame, std::size_t wisp, std::size_t i, std::size_t k) {
        return frames[frame].radius[section(wisp, i) * setup.groom.envelope_points + k];
    }
    float& radius_rate(std::size_t frame, std::size_t wisp, std::size_t i, std::size_t k) {
        return frames[frame].radius_rate[section(wisp, i) * setup.groom.envelope_points + k];
    }
    /// Adds an obstacle that does not move.
    void add_obstacle(const Mesh& mesh, bool worn);
    /// Writes a file, and has it judged.
    CheckReport judge() const;
    /// Writes a file, and has its figures taken.
    std::vector<FrameFigures> figures() const;

  private:
    template <typename Look> auto look_at(const Look& look) const;
};

inline constexpr double kFrameRate = 24; // [Hz] of synthetic runs
inline constexpr double kStop = 2;       // [s] when the head comes to rest
inline constexpr Vec3 kHead = {0, 1.5f, 0};
inline constexpr float kHeadRadius = 0.1f;
inline constexpr std::size_t kTip = 7; // sections 0 … 7 of each wisp

/// Eleven seconds of a round head that goes to and fro twice and stops at `kStop`, with three wisps
/// of six segments, 0.3 m long, that follow it a little later and later toward their tips. All that
/// the judge asks for is right. Wisp 0 hangs at +x, 1 at −x, 2 at +z.
SyntheticRun good_run();

/// The frame at a time [s] of a synthetic run.
constexpr std::size_t frame_at(double time) {
    return static_cast<std::size_t>(time * kFrameRate + 0.5);
}

} // namespace mane::test
