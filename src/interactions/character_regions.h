#pragma once

#include "base/four.h"
#include "character/surface.h"
#include "interactions/character_region_test.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Clear regions of all sections toward one body, kept from block to block. They show that most
/// sections cannot touch the body, and have not met it, without looking at its surface: the way
/// that hair and surface have gone since is taken off what was known (docs/interactions.md).
class CharacterRegions {
  public:
    /// A section's region at the block's start, in the world.
    struct Here {
        Vec3d normal, centre;
        double height = 0, radius = -1, ball = -1, far = -1;
        /// [m] nothing of the surface is nearer to `p`; negative where nothing is known
        double clear(const Vec3d& p) const;
    };
    Here here(Slot slot) const;

    /// For a block of `surface`, at its start. Whatever was known is forgotten unless the block
    /// before was taken to its end.
    void begin(const HairView& hair, const Surface& surface);
    /// Asks for a packet. `reach` [m]: what is no farther may be met, beside what velocities bring;
    /// `share`: of the bound on both.
    void approach(const RegionTest& test, const HairView& hair, std::size_t packet, double reach,
                  float share, RegionTest::Approach* rows);
    /// Looks for a section's region again; `least` [m]: how far what hangs on it reaches. `near`: a
    /// triangle that may be near, or that is the `nearest`; then the nearest, if it was met.
    void renew(Slot slot, const Vec3& x, double least, std::uint32_t& near, bool nearest);

    /// Whether the regions are those of the block that `surface` is in.
    bool current(const Surface& surface) const {
        return surface_ == &surface && block_ == surface.block() && jumps_ == surface.jumps() &&
               !ended_;
    }
    /// Asks for a packet, and takes its regions to the block's end.
    void stay(const RegionTest& test, const HairView& hair, std::size_t packet,
              std::uint16_t* rows);
    void end() { ended_ = true; }

  private:
    /// What a ball has over a plane.
    struct Cap {
        Vec3 normal;
        float height = 1e30f; // no plane
        double radius = 0;
    };
    struct Nearby {
        std::uint64_t groups = 0;
        float far = 0; // where the next of the others is
    };
    /// Four boxes side by side, [axis].
    struct FourBoxes {
        Four low[3], high[3];
    };
    static Cap cap_over(const PosedSurface& surface, const Vec3& x, const Vec3& normal,
                        float distance, double least);
    void find_motion();
    void find_boxes(const TriangleTree& tree);
    Nearby groups_within(const Vec3& p, float radius) const;
    void keep(Slot slot, const Vec3d& p, const Cap& cap, double ball, double wide);
    void find_stray(const Packet& packet);
    float& number(Slot slot, std::uint32_t column) { return region_.at(slot, column); }
    RegionQuestion question(const HairView& hair);

    const Surface* surface_ = nullptr;
    std::uint64_t block_ = 0, jumps_ = 0;
    bool ended_ = false;
    std::vector<FrameMotion> motion_;
    std::vector<FourBoxes> boxes_; // of the groups, at the block's start
    Rows region_;
    std::vector<std::uint64_t> groups_; // minded by each slot's region
};

} // namespace mane
