#include "character/bust_chain.h"
#include "character/clip_pose.h"
#include "character/low_pass.h"
#include "mane/character.h"
#include "mane/error.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

using BustNames = std::array<std::string, kBustBones>;

// The naming families: CMU's own, the one of Motion Builder, DAZ's.
const BustNames kFamilies[] = {
    {"Spine1", "Neck1", "Head"}, {"Chest2", "Neck", "Head"}, {"chest", "neck", "head"}};

std::size_t find_joint(const Clip& clip, const std::string& name) {
    const auto found = std::find_if(clip.joints.begin(), clip.joints.end(),
                                    [&](const Clip::Joint& j) { return j.name == name; });
    return static_cast<std::size_t>(found - clip.joints.begin());
}

std::string all_names(const Clip& clip) {
    std::string names;
    for (const Clip::Joint& j : clip.joints)
        if (!j.name.empty())
            names += (names.empty() ? "" : ", ") + j.name;
    return names;
}

std::array<std::size_t, kBustBones> bust_joints_of(const Clip& clip, const BustNames& wanted) {
    const auto complete = [&](const BustNames& family) {
        for (std::size_t b = 0; b < kBustBones; ++b)
            if (wanted[b].empty() && find_joint(clip, family[b]) == clip.joints.size())
                return false;
        return true;
    };
    const auto family = std::find_if(std::begin(kFamilies), std::end(kFamilies), complete);
    if (family == std::end(kFamilies))
        throw InputError(clip.source +
                         ": chest, neck and head are not found by name, set them; "
                         "the clip's joints are " +
                         all_names(clip));
    std::array<std::size_t, kBustBones> joints{};
    for (std::size_t b = 0; b < kBustBones; ++b) {
        const std::string& name = wanted[b].empty() ? (*family)[b] : wanted[b];
        joints[b] = find_joint(clip, name);
        if (joints[b] == clip.joints.size())
            throw InputError(clip.source + ": no joint \"" + name + "\"; the clip's joints are " +
                             all_names(clip));
    }
    return joints;
}

// The frames used, and when each is.
struct FrameRange {
    double fps;
    std::size_t earliest, last;
    std::vector<double> times;
};

void check_positive(const Clip& clip, const char* what, double value) {
    if (!(value > 0) || !std::isfinite(value))
        throw InputError(clip.source + ": " + what + " is " + std::to_string(value) +
                         ", expected more than 0");
}

FrameRange frame_range(const Clip& clip, const ClipMotionDesc& desc) {
    const double fps = desc.fps == 0 ? 1 / clip.frame_time : desc.fps;
    check_positive(clip, "fps", fps);
    FrameRange range{fps, std::min(desc.earliest, desc.first), 0, {}};
    range.last = std::min<std::size_t>(desc.last, std::size_t{clip.frame_count} - 1);
    if (clip.frame_count == 0 || desc.first > range.last)
        throw InputError(clip.source + ": frames " + std::to_string(desc.first) + " to " +
                         std::to_string(desc.last) + " of a clip of " +
                         std::to_string(clip.frame_count) + " frames, expected at least one");
    for (std::size_t f = range.earliest; f <= range.last; ++f)
        range.times.push_back((static_cast<double>(f) - desc.first) / fps);
    return range;
}

// Low-passed in place. Quaternions with aligned signs are averaged as vectors: with positive
// weights over a few hundredths of a second this is, once normalised, the mean rotation (filtering
// Euler angles would depend on the axes and break at their jumps).
class BustTracks {
  public:
    BustTracks(const Clip& clip, const ClipMotionDesc& desc)
        : BustTracks(clip, desc, frame_range(clip, desc),
                     bust_joints_of(clip, {desc.chest, desc.neck, desc.head})) {}

    PointMotion head(double time) const {
        const auto [p, v] = position_.evaluate(time);
        return {{p[0], p[1], p[2]}, {v[0], v[1], v[2]}};
    }
    BustTurning turning(double time) const {
        return {turning_of(chest_.evaluate(time)), turning_of(neck_.evaluate(time)),
                turning_of(head_.evaluate(time))};
    }

  private:
    BustTracks(const Clip& clip, const ClipMotionDesc& desc, const FrameRange& range,
               const std::array<std::size_t, kBustBones>& joints)
        : position_(position_track(clip, desc, range, joints[kHeadBone])),
          chest_(rotation_track(clip, desc, range, joints[kChestBone])),
          neck_(rotation_track(clip, desc, range, joints[kNeckBone])),
          head_(rotation_track(clip, desc, range, joints[kHeadBone])) {}

    template <std::size_t N> static Track<N> filtered(const ClipMotionDesc& desc,
                                                      const FrameRange& range,
                                                      std::vector<std::array<double, N>> samples) {
        if (desc.lowpass > 0 && samples.size() > 1)
            gaussian_low_pass(samples, gaussian_width(desc.lowpass, range.fps));
        return {range.times, samples, TrackEnd::coast};
    }
    static Track<3> position_track(const Clip& clip, const ClipMotionDesc& desc,
                                   const FrameRange& range, std::size_t joint) {
        auto samples = joint_trajectory(clip, joint, range.earliest, range.last).positions;
        for (auto& p : samples)
            for (double& x : p)
                x *= desc.unit;
        return filtered(desc, range, std::move(samples));
    }
    static Track<4> rotation_track(const Clip& clip, const ClipMotionDesc& desc,
                                   const FrameRange& range, std::size_t joint) {
        auto samples = joint_trajectory(clip, joint, range.earliest, range.last).rotations;
        align_signs(samples);
        return filtered(desc, range, std::move(samples));
    }

    Track<3> position_;
    Track<4> chest_, neck_, head_;
};

class ClipMotion final : public Motion {
  public:
    ClipMotion(const Clip& clip, const ClipMotionDesc& desc, const BustJoints& joints)
        : tracks_(clip, desc), joints_(joints) {}

    std::size_t bone_count() const override { return kBustBones; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        pose_from_head(joints_, tracks_.head(time), tracks_.turning(time), bones);
    }

  private:
    BustTracks tracks_;
    BustJoints joints_;
};

} // namespace

std::shared_ptr<const Motion> clip_motion(const Clip& clip, const ClipMotionDesc& desc,
                                          const BustJoints& joints) {
    check_positive(clip, "unit", desc.unit);
    if (!(desc.lowpass >= 0) || !std::isfinite(desc.lowpass))
        throw InputError(clip.source + ": low-pass at " + std::to_string(desc.lowpass) +
                         " Hz, expected 0 (none) or more");
    return std::make_shared<ClipMotion>(clip, desc, joints);
}

} // namespace mane
