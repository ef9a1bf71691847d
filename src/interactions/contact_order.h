#pragma once

#include "model/layout.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The order in which contacts between wisps keep the sections: by halves of halves of the
/// design, since hair stays beside the hair that it grew beside. What is together in space is then
/// together in memory, for a hundred wisps as for ten thousand. A section's place in the order is
/// its *rank*.
class ContactOrder {
  public:
    static constexpr std::uint32_t kNone = ~0u;

    ContactOrder() = default;
    ContactOrder(const Groom& groom, const Layout& layout);

    std::uint32_t size() const { return static_cast<std::uint32_t>(section_.size()); }
    std::uint32_t rank(std::uint32_t section) const { return rank_[section]; }
    std::uint32_t section(std::uint32_t rank) const { return section_[rank]; }
    /// The rank of the section after, toward the tip; kNone at a tip.
    std::uint32_t next(std::uint32_t rank) const { return next_[rank]; }
    /// The rank of the section before, toward the root; kNone at a root.
    std::uint32_t before(std::uint32_t rank) const { return before_[rank]; }
    /// The sixteen ranks of a packet's row; kNone where a lane has no section.
    const std::uint32_t* row(std::size_t r) const { return at_.data() + r * kLanes; }

  private:
    std::vector<std::uint32_t> section_, rank_, next_, before_, at_;
};

} // namespace mane
