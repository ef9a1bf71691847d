#include "character/bust_chain.h"
#include "character/clip_pose.h"
#include "character/low_pass.h"
#include "mane/character.h"
#include "mane/error.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

// The clip's joints that drive the bust. Its neck is not among them: captured necks share the
// turning of the head unevenly, even with opposite signs (in the salsa clips +20° and −65°), which
// folds a smooth skin.
struct JointNames {
    std::string chest, head;
};
struct Joints {
    std::size_t chest, head;
};

// The naming families: CMU's own, the one of Motion Builder, DAZ's.
const JointNames kFamilies[] = {{"Spine1", "Head"}, {"Chest2", "Head"}, {"chest", "head"}};

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

std::size_t require_joint(const Clip& clip, const std::string& name) {
    const std::size_t joint = find_joint(clip, name);
    if (joint == clip.joints.size())
        throw InputError(clip.source + ": no joint \"" + name + "\"; the clip's joints are " +
                         all_names(clip));
    return joint;
}

Joints find_joints(const Clip& clip, const JointNames& set) {
    const auto fits = [&](const std::string& set_name, const std::string& name) {
        return !set_name.empty() || find_joint(clip, name) < clip.joints.size();
    };
    const auto family =
        std::find_if(std::begin(kFamilies), std::end(kFamilies), [&](const JointNames& f) {
            return fits(set.chest, f.chest) && fits(set.head, f.head);
        });
    if (family == std::end(kFamilies))
        throw InputError(
            clip.source +
            ": chest and head are not found by name, set them; the clip's joints are " +
            all_names(clip));
    return {require_joint(clip, set.chest.empty() ? family->chest : set.chest),
            require_joint(clip, set.head.empty() ? family->head : set.head)};
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

// The motion of the clip's head and chest, low-passed. Quaternions with aligned signs are averaged
// as vectors: with positive weights over a few hundredths of a second this is, once normalised, the
// mean rotation (filtering Euler angles would depend on the axes and break at their jumps).
class BustTracks {
  public:
    BustTracks(const Clip& clip, const ClipMotionDesc& desc)
        : BustTracks(Samples(clip, desc, frame_range(clip, desc),
                             find_joints(clip, {desc.chest, desc.head}))) {}

    PointMotion head(double time) const {
        const auto [p, v] = position_.evaluate(time);
        return {{p[0], p[1], p[2]}, {v[0], v[1], v[2]}};
    }
    // The neck is turned halfway between chest and head.
    BustTurning turning(double time) const {
        const TrackPoint<4> chest = chest_.evaluate(time), head = head_.evaluate(time);
        TrackPoint<4> neck;
        for (std::size_t c = 0; c < 4; ++c) {
            neck.value[c] = chest.value[c] + head.value[c];
            neck.rate[c] = chest.rate[c] + head.rate[c];
        }
        return {turning_of(chest), turning_of(neck), turning_of(head)};
    }

  private:
    struct Samples {
        std::vector<double> times;
        JointTrajectory chest, head;

        Samples(const Clip& clip, const ClipMotionDesc& desc, const FrameRange& range,
                const Joints& joints)
            : times(range.times),
              chest(joint_trajectory(clip, joints.chest, range.earliest, range.last)),
              head(joint_trajectory(clip, joints.head, range.earliest, range.last)) {
            for (auto& p : head.positions)
                for (double& x : p)
                    x *= desc.unit;
            align_signs(chest.rotations);
            align_signs(head.rotations, chest.rotations.front());
            if (desc.lowpass == 0 || times.size() == 1)
                return;
            const double width = gaussian_width(desc.lowpass, range.fps);
            gaussian_low_pass(head.positions, width);
            gaussian_low_pass(chest.rotations, width);
            gaussian_low_pass(head.rotations, width);
        }
    };
    explicit BustTracks(const Samples& s)
        : position_(s.times, s.head.positions, TrackEnd::coast),
          chest_(s.times, s.chest.rotations, TrackEnd::coast),
          head_(s.times, s.head.rotations, TrackEnd::coast) {}

    Track<3> position_;
    Track<4> chest_, head_;
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
