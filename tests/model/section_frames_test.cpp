#include "model/section_frames.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

using namespace mane;

namespace {

using Frames = std::vector<SectionFrame<double>>;

Frames frames_of(const std::vector<Vec3d>& curve, const Vec3d& first) {
    Frames frames(curve.size());
    section_frames<double>(curve, first, frames);
    return frames;
}

Vec3d turned(const Vec3d& v, const Vec3d& axis, double angle) {
    const Vec3d s = axis * std::sin(angle / 2);
    return Quatd{s.x, s.y, s.z, std::cos(angle / 2)}.rotate(v);
}

std::vector<Vec3d> random_curve(std::mt19937& random, double bend) {
    std::uniform_real_distribution<double> u(-1, 1);
    Vec3d direction{0, -1, 0};
    std::vector<Vec3d> curve{{0.1, 1.6, 0}};
    for (int i = 0; i < 9; ++i) {
        const Vec3d axis = normalized(cross(direction, Vec3d{u(random), u(random), u(random)}));
        direction = turned(direction, axis, bend * std::abs(u(random)));
        curve.push_back(curve.back() + direction * (0.03 + 0.02 * u(random)));
    }
    return curve;
}

double largest(const Vec3d& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

} // namespace

TEST_CASE("section frames: right-handed, in the planes that bisect the segments") {
    std::mt19937 random(1);
    for (int round = 0; round < 50; ++round) {
        const std::vector<Vec3d> curve = random_curve(random, 2.4);
        const Frames frames = frames_of(curve, {1, 0.3, 0.2});
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const auto& f = frames[i];
            CHECK(length(f.u) == doctest::Approx(1).epsilon(1e-12));
            CHECK(std::abs(dot(f.u, f.normal)) < 1e-12);
            CHECK(largest(cross(f.normal, f.u) - f.v) < 1e-12);
            if (i == 0 || i + 1 == curve.size())
                continue;
            const Vec3d a = normalized(curve[i] - curve[i - 1]),
                        b = normalized(curve[i + 1] - curve[i]);
            CHECK(dot(f.normal, a) == doctest::Approx(dot(f.normal, b)).epsilon(1e-12));
        }
    }
}

TEST_CASE("section frames: each is the one before, turned about the axis normal to both planes' "
          "normals (M8)") {
    std::mt19937 random(2);
    for (int round = 0; round < 50; ++round) {
        const Frames frames = frames_of(random_curve(random, 1.5), {1, 0, 0});
        for (std::size_t i = 1; i < frames.size(); ++i) {
            const Vec3d c = cross(frames[i - 1].normal, frames[i].normal);
            const double sine = length(c);
            if (sine < 1e-9)
                continue;
            const Vec3d expected =
                turned(frames[i - 1].u, c / sine,
                       std::atan2(sine, dot(frames[i - 1].normal, frames[i].normal)));
            CHECK(largest(frames[i].u - expected) < 1e-12);
        }
    }
}

TEST_CASE("section frames: an axis across the plane of a plane curve stays as it is") {
    std::vector<Vec3d> curve;
    for (int i = 0; i < 12; ++i)
        curve.push_back({std::cos(0.5 * i), std::sin(0.5 * i), 0});
    for (const auto& f : frames_of(curve, {0, 0, 1}))
        CHECK(largest(f.u - Vec3d{0, 0, 1}) < 1e-14);
}

TEST_CASE("section frames: the float twin is the double one to float accuracy, and a closed motion "
          "brings it back") {
    std::mt19937 random(3);
    const std::vector<Vec3d> curve = random_curve(random, 1.2);
    const std::vector<Vec3> narrow(curve.begin(), curve.end());
    std::vector<SectionFrame<float>> once(curve.size()), again(curve.size());
    section_frames<float>(narrow, {1, 0, 0}, once);
    const Frames wide = frames_of(curve, {1, 0, 0});
    // Directions of 2 cm segments at 1.6 m: 1.6 · 2⁻²⁴ / 0.01 each, carried over ten sections.
    for (std::size_t i = 0; i < curve.size(); ++i)
        CHECK(largest(Vec3d(once[i].u) - wide[i].u) < 1e-4);

    std::vector<Vec3> moved = narrow;
    for (Vec3& p : moved)
        p = {p.y, -p.x * 2, p.z + p.y};
    section_frames<float>(moved, {0, 1, 0}, again);
    section_frames<float>(narrow, {1, 0, 0}, again);
    for (std::size_t i = 0; i < curve.size(); ++i)
        CHECK(once[i].u == again[i].u);
}

TEST_CASE("section frames: a curve that folds back, and segments without length, stay finite") {
    for (const std::vector<Vec3d>& curve :
         {std::vector<Vec3d>{{0, 0, 0}, {0, -1, 0}, {0, 0, 0}, {0, -1, 0}},
          std::vector<Vec3d>{{0, 0, 0}, {0, -1, 0}, {0, -1, 0}, {0, -2, 0}}}) {
        const Frames frames = frames_of(curve, {1, 0, 0});
        for (const auto& f : frames) {
            CHECK(std::isfinite(dot(f.u, f.v)));
            CHECK(std::isfinite(dot(f.normal, f.normal)));
        }
        CHECK(largest(frames[1].normal - Vec3d{0, -1, 0}) < 1e-12);
    }
}

namespace {

/// The angle by which one frame is turned from another [deg]: from the trace of the rotation.
double turn(const SectionFrame<double>& a, const SectionFrame<double>& b) {
    const double trace = dot(a.u, b.u) + dot(a.v, b.v) + dot(a.normal, b.normal);
    return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// `curve` with its joint `joint` bent by `angle` in a plane turned by `azimuth` about the segment
/// before; the rest of the curve comes along.
std::vector<Vec3d> bent(std::vector<Vec3d> curve, std::size_t joint, double angle, double azimuth) {
    const Vec3d along = normalized(curve[joint] - curve[joint - 1]);
    const Vec3d now = normalized(curve[joint + 1] - curve[joint]);
    // First straightened, then bent.
    const Vec3d across = cross(now, along);
    const double bend = std::atan2(length(across), dot(now, along));
    const Vec3d axis = turned(normalized(cross(along, Vec3d{0.6, 0, 0.8})), along, azimuth);
    for (std::size_t i = joint + 1; i < curve.size(); ++i) {
        const Vec3d straight = turned(curve[i] - curve[joint], normalized(across), bend);
        curve[i] = curve[joint] + turned(straight, axis, angle);
    }
    return curve;
}

} // namespace

TEST_CASE(
    "section frames: none turns over 5° in a step while a joint bends up to 149° at 16 rad/s, "
    "and the closed motion brings back every bit (M8)") {
    constexpr int kSteps = 1000; // of 1 ms, in one swing to and fro
    std::mt19937 random(4);
    double most = 0, widest = 0;
    for (int round = 0; round < 6; ++round) {
        const std::vector<Vec3d> rest = random_curve(random, 1);
        for (std::size_t joint = 1; joint + 1 < rest.size(); ++joint) {
            const auto frames_at = [&](int step) {
                const double phase = 2 * std::numbers::pi * (step % kSteps) / kSteps;
                const double angle = 149 * std::numbers::pi / 180 * std::sin(phase);
                const std::vector<Vec3d> curve = bent(rest, joint, angle, phase);
                widest =
                    std::max(widest, std::acos(dot(normalized(curve[joint] - curve[joint - 1]),
                                                   normalized(curve[joint + 1] - curve[joint]))));
                return frames_of(curve, {0.3, 1, 0.2});
            };
            const Frames start = frames_at(0);
            Frames before = start;
            for (int step = 1; step <= kSteps; ++step) {
                const Frames now = frames_at(step);
                for (std::size_t i = 0; i < now.size(); ++i)
                    most = std::max(most, turn(before[i], now[i]));
                before = now;
            }
            for (std::size_t i = 0; i < start.size(); ++i)
                CHECK((before[i].u == start[i].u && before[i].v == start[i].v));
        }
    }
    MESSAGE("largest turn in a step: " << most << "°, widest bend "
                                       << widest * 180 / std::numbers::pi << "°");
    CHECK(widest > 148.9 * std::numbers::pi / 180);
    CHECK(most < 5);
}
