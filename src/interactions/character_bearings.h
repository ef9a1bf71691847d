#pragma once

#include "base/four.h"
#include "interactions/character_contact.h"
#include "interactions/character_escape.h"
#include "interactions/character_point.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// What the penetration reaction knows of a wisp at the block's end: which sections are inside
/// bodies, and what no surface comes near. An answer is found when first asked for, and forgotten
/// when the section moves.
///
/// Most need no query of their own: where the surface of a body stays under all points of a hull,
/// along one way, nothing of it is between them.
class CharacterBearings {
  public:
    CharacterBearings(const WispCopy& wisp, std::span<const ContactBody> bodies,
                      const Escape& escape)
        : wisp_(wisp), bodies_(bodies), escape_(escape) {}

    /// Another wisp was loaded. `carried`: bodies × sections, found at the block's start, or now
    /// where they were not looked for.
    void begin(std::span<CarriedPoint> carried);

    /// What a clear region tells: section i is outside body `b`, and its segment is free.
    void set_free(std::uint32_t i, std::uint32_t b);
    /// Section i at the block's start, and carried along with body `b`.
    const CarriedPoint& carried(std::uint32_t i, std::uint32_t b);

    bool inside(std::uint32_t i, std::uint32_t b);
    /// Whether the axis from section i − 1 to i meets no surface of body `b`.
    bool axis_free(std::uint32_t i, std::uint32_t b);

    /// Whether nothing of body `b` comes between what hangs on section i and on the segment that
    /// ends there: the axis, the section's envelope, the drawn surface halfway along the segment,
    /// and the way from where the section was carried. A bound that may fail to tell.
    bool segment_free(std::uint32_t i, std::uint32_t b);

    /// How high a body's surface comes along a way, near some points.
    struct Roof {
        Vec3 way;
        float height;

        /// Whether it stays under the line between two of the points.
        bool under(const Vec3& a, const Vec3& b) const {
            return std::min(dot(way, a), dot(way, b)) > height;
        }
    };
    /// Near what is drawn of section i.
    Roof section_roof(std::uint32_t i, std::uint32_t b);
    /// Near what is drawn halfway along the segment that ends there.
    Roof halfway_roof(std::uint32_t i, std::uint32_t b);

    /// Section i has moved.
    void forget(std::uint32_t i);
    /// The envelope of section i has.
    void forget_envelope(std::uint32_t i);

  private:
    static constexpr float kOver = 1e-5f; // [m] over the rounding of positions
    enum class Answer : std::uint8_t { unknown, no, yes };
    struct Known {
        Answer inside = Answer::unknown;
        Answer axis_free = Answer::unknown; ///< of the axis that ends here
        Answer segment_free = Answer::unknown;
    };
    /// Points: the box around them, and how low they come along a way.
    struct Extent {
        Vec3 way;
        Four low, high;
        float lowest;

        explicit Extent(const Vec3& along);
        void add(const Four& point);
    };
    bool find_segment_free(std::uint32_t i, std::uint32_t b);
    Roof roof(const Extent& extent, std::uint32_t b, float enough) const;
    std::span<const Four> drawn(std::uint32_t i);
    void add_drawn(std::uint32_t i, Extent& extent);
    void add_halfway(std::uint32_t i, Extent& extent);
    Vec3 way_out(std::uint32_t i, std::uint32_t b) const;
    void settle(CarriedPoint& carried, std::uint32_t i, const Surface& surface) const;
    std::size_t at(std::uint32_t i, std::uint32_t b) const { return b * wisp_.sections() + i; }

    const WispCopy& wisp_;
    std::span<const ContactBody> bodies_;
    const Escape& escape_;
    std::span<CarriedPoint> carried_;
    std::vector<Vec3> came_to_;             // where the sections were before the reaction
    std::vector<Known> known_;              // bodies × sections
    std::vector<Four> drawn_;               // sections × (1 + 2 K): see drawn()
    std::vector<std::uint8_t> drawn_known_; // per section
};

} // namespace mane
