#include "clip_data.h"

#include "mane/character.h"
#include "mane/error.h"
#include "mane/import.h"

#include <algorithm>
#include <cmath>

using namespace mane;

namespace {

struct TableRow {
    const char* name;
    double fps, unit;
    std::uint32_t first;
    double v, a, omega, alpha; // peaks, as the data's table has them
};
const TableRow kTable[] = {
    {"01_01_cmu_forward-jumps-turn", 120, 0.0564444, 1, 2.4, 57, 7.7, 288},
    {"55_01_cmu_dance-whirl", 120, 0.0564444, 1, 1.1, 19, 4.5, 168},
    {"09_11_cmu_run", 120, 0.0564444, 1, 3.8, 30, 1.6, 88},
    {"07_01_cmu_walk", 120, 0.0564444, 1, 1.6, 27, 2.4, 240},
    {"12_01_walk", 120, 0.0564444, 1, 1.1, 12, 1.0, 110},
    {"scaled_131_03_mj-start-hop-stop", 120, 1, 0, 2.0, 20, 7.4, 39},
    {"60_12_scaled_salsa", 60, 1.28, 4, 1.2, 37, 8.6, 257},
    {"61_11_scaled_salsa", 60, 1.28, 4, 1.8, 27, 22.7, 197},
    {"61_14_scaled_salsa", 60, 1.28, 4, 2.3, 35, 21.0, 252},
};

struct HeadPath {
    std::vector<Vec3d> position;
    std::vector<Quatd> rotation;
};

// The head's joint at the times of the clip's frames.
HeadPath head_path(const Motion& motion, double fps, std::size_t frames) {
    HeadPath path;
    BonePose bones[kBustBones];
    for (std::size_t f = 0; f < frames; ++f) {
        motion.evaluate(static_cast<double>(f) / fps, bones);
        const BonePose& head = bones[kHeadBone];
        path.position.push_back(head.position + head.rotation.rotate(bust_joints().head));
        path.rotation.push_back(head.rotation);
    }
    return path;
}

// Central differences, as the table's peaks were taken.
std::vector<Vec3d> rates(const std::vector<Vec3d>& x, double fps) {
    std::vector<Vec3d> r(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t before = i ? i - 1 : 0, after = std::min(i + 1, x.size() - 1);
        r[i] = (x[after] - x[before]) * (fps / static_cast<double>(after - before));
    }
    return r;
}

// Turning from each frame to the next.
std::vector<Vec3d> turns(const std::vector<Quatd>& q, double fps) {
    std::vector<Vec3d> turn;
    for (std::size_t i = 0; i + 1 < q.size(); ++i) {
        const Quatd d = q[i + 1] * q[i].conjugate();
        const Vec3d axis(d.x, d.y, d.z);
        const double angle = 2 * std::atan2(length(axis), std::fabs(d.w));
        turn.push_back(normalized(axis) * (d.w < 0 ? -angle : angle) * fps);
    }
    return turn;
}

double peak(const std::vector<Vec3d>& x, std::size_t margin) {
    double most = 0;
    for (std::size_t i = margin; i + margin < x.size(); ++i)
        most = std::max(most, length(x[i]));
    return most;
}

ClipMotionDesc desc_of(const TableRow& row) {
    ClipMotionDesc desc;
    desc.unit = row.unit;
    desc.fps = row.fps;
    desc.first = desc.earliest = row.first;
    desc.lowpass = row.fps == 120 ? 20 : 15;
    return desc;
}

} // namespace

TEST_CASE("the head's peaks of the nine clips are those of the data's table") {
    for (const TableRow& row : kTable) {
        const std::string path = shared_data(std::string("mocap/") + row.name + ".bvh");
        if (path.empty())
            continue;
        const Clip clip = read_bvh(path);
        const auto motion = clip_motion(clip, desc_of(row));
        const HeadPath head = head_path(*motion, row.fps, clip.frame_count - row.first);
        const std::vector<Vec3d> v = rates(head.position, row.fps),
                                 w = turns(head.rotation, row.fps);
        CAPTURE(row.name);
        // the table has two or three digits; three frames at the ends are left out, where the
        // continuation of the signal matters
        const std::size_t margin = 3;
        CHECK(peak(v, margin) == doctest::Approx(row.v).epsilon(0.04));
        CHECK(peak(rates(v, row.fps), margin) == doctest::Approx(row.a).epsilon(0.03));
        CHECK(peak(w, margin) == doctest::Approx(row.omega).epsilon(0.03));
        CHECK(peak(rates(w, row.fps), margin) == doctest::Approx(row.alpha).epsilon(0.03));
    }
}

TEST_CASE(
    "people in the clips walk upright, with the bust's face forward and at a person's height") {
    for (const TableRow& row : {kTable[2], kTable[3], kTable[4]}) {
        const std::string path = shared_data(std::string("mocap/") + row.name + ".bvh");
        if (path.empty())
            continue;
        CAPTURE(row.name);
        const Clip clip = read_bvh(path);
        const auto motion = clip_motion(clip, desc_of(row));
        const double duration = (clip.frame_count - 1 - row.first) / row.fps;
        BonePose start[kBustBones], end[kBustBones], bones[kBustBones];
        motion->evaluate(0, start);
        motion->evaluate(duration, end);
        const Vec3d way = normalized(end[0].position - start[0].position);
        for (double time = 0; time < duration; time += 0.1) {
            motion->evaluate(time, bones);
            for (const BonePose& bone : bones) {
                CHECK(bone.rotation.rotate({0, 1, 0}).y > std::cos(35 * 3.14159 / 180));
                CHECK(dot(bone.rotation.rotate({0, 0, 1}), way) > std::cos(45 * 3.14159 / 180));
            }
            const Vec3d head =
                bones[kHeadBone].rotation.rotate(bust_joints().head) + bones[kHeadBone].position;
            CHECK(head.y > 1.2);
            CHECK(head.y < 1.7);
        }
    }
}

TEST_CASE("the whirl turns by 1976°, and the dip's head is upside-down when it should be") {
    const std::string whirl = shared_data("mocap/55_01_cmu_dance-whirl.bvh");
    if (!whirl.empty()) {
        const Clip clip = read_bvh(whirl);
        const auto motion = clip_motion(clip, desc_of(kTable[1]));
        BonePose bones[kBustBones];
        double yaw = 0, last = 0;
        for (std::uint32_t f = 0; f + 1 < clip.frame_count; ++f) {
            motion->evaluate(f / 120.0, bones);
            const Vec3d face = bones[kChestBone].rotation.rotate({0, 0, 1});
            const double now = std::atan2(face.x, face.z);
            if (f > 0)
                yaw += std::remainder(now - last, 2 * 3.14159265358979);
            last = now;
        }
        CHECK(std::fabs(yaw) * 180 / 3.14159265358979 ==
              doctest::Approx(1976).epsilon(0.03)); // the table's is the hips'
    }
    const std::string dip = shared_data("mocap/61_14_scaled_salsa.bvh");
    if (!dip.empty()) {
        const auto motion = clip_motion(read_bvh(dip), desc_of(kTable[8]));
        BonePose bones[kBustBones];
        std::uint32_t first = 0, last = 0;
        for (std::uint32_t f = 440; f < 968; ++f) {
            motion->evaluate((f - 4.0) / 60, bones);
            if (bones[kHeadBone].rotation.rotate({0, 1, 0}).y >= 0)
                continue;
            if (first == 0)
                first = f;
            last = f;
        }
        CHECK(first == doctest::Approx(486).epsilon(0.005));
        CHECK(last == doctest::Approx(544).epsilon(0.005));
    }
}
