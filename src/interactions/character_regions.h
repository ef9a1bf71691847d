#pragma once

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
    /// Looks for a section's region again; `wanted` [m]: the radius that is of use. `near`: a
    /// triangle that may be near; then the nearest, if it was met.
    void renew(Slot slot, const Vec3& x, double wanted, std::uint32_t& near);

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
    void find_motion();
    void find_stray(const Packet& packet);
    float& number(Slot slot, std::uint32_t column) { return region_.at(slot, column); }
    RegionQuestion question(const HairView& hair);

    const Surface* surface_ = nullptr;
    std::uint64_t block_ = 0, jumps_ = 0;
    bool ended_ = false;
    std::vector<FrameMotion> motion_;
    std::vector<TriangleTree::Box> boxes_; // of the groups, at the block's start
    Rows region_;
    std::vector<std::uint64_t> groups_; // minded by each slot's region
};

} // namespace mane
