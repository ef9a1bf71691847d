#pragma once

#include "interactions/character_contact.h"

#include <optional>
#include <vector>

namespace mane {

/// Ways out of bodies at a block's end: where a point that went in, or through, can be put (M32,
/// M33). Scratch is kept between calls.
class Escape {
  public:
    Escape(std::span<const ContactBody> bodies, double push_out)
        : bodies_(bodies), push_out_(push_out) {}

    /// Whether `p` is inside any body whose entry of `exempt` is 0.
    bool inside(const Vec3& p, std::span<const std::uint8_t> exempt) const;
    /// Whether `p` is inside body `b`.
    bool inside(const Vec3& p, std::uint32_t b) const { return pose(b).inside(Vec3d(p)); }

    /// Where the segment from `from` (outside) to `to` enters body `b` first: a place of its
    /// surface and the position on the segment.
    struct Entry {
        SurfacePlace place;
        double at = 0;
    };
    std::optional<Entry> entry(std::uint32_t b, const Vec3& from, const Vec3& to);
    /// Where the segment enters to stay inside at its end (an odd spring, M31): empty when its
    /// crossings cancel.
    std::optional<Entry> entry_to_stay(std::uint32_t b, const Vec3& from, const Vec3& to);
    /// The middle of the longest stretch of the segment inside body `b`, 0 … 1; both ends are
    /// outside.
    std::optional<float> middle_of_stretch(std::uint32_t b, const Vec3& from, const Vec3& to);
    bool free(std::uint32_t b, const Vec3& from, const Vec3& to) const {
        return !pose(b).crosses(Vec3d(from), Vec3d(to));
    }

    /// The nearest place of body `b`'s surface with open space before it, seen from `p` inside.
    std::optional<SurfacePlace> exit(std::uint32_t b, const Vec3& p) const;
    /// The point over a place at the push-out's height, or in the middle of a gap that is narrower
    /// than twice that (M33). `inside`: a point on the place's inner side, or on the surface.
    Vec3 over(std::uint32_t b, const SurfacePlace& place, const Vec3& inside, double height);
    Vec3 over(std::uint32_t b, const SurfacePlace& place, const Vec3& inside) {
        return over(b, place, inside, push_out_);
    }

  private:
    const PosedSurface& pose(std::uint32_t b) const { return bodies_[b].surface->end(); }
    Vec3d outward(std::uint32_t b, const SurfacePlace& place, const Vec3d& inside) const;
    Entry entry_at(std::uint32_t b, const Crossing& crossing, const Vec3d& from,
                   const Vec3d& to) const;

    std::span<const ContactBody> bodies_;
    double push_out_;
    std::vector<Crossing> crossings_;
};

} // namespace mane
