#pragma once

#include "base/parallel_for.h"
#include "interactions/grid.h"
#include "interactions/segments.h"
#include "interactions/wisp_contact.h"
#include "mane/desc.h"
#include "model/ablation.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Finds the contacts between wisps, and of a wisp with itself (§4.1, M21–M23).
class WispDetection {
  public:
    explicit WispDetection(const WispContactDesc& desc, const Ablation& ablation = {});

    /// Finds all contacts anew, in order. A contact that was there at the last call keeps its kind
    /// within the hysteresis.
    void detect(const HairView& hair, Threads& threads);

    std::span<const WispContact> contacts() const { return contacts_; }
    /// Pairs of segments of which one has a point inside the other, at the last call: the paper's
    /// intersections, each once.
    std::uint64_t intersecting_pairs() const { return intersecting_pairs_; }

  private:
    /// What a chunk of sections found.
    struct Found {
        std::vector<WispContact> contacts;
        std::vector<std::uint64_t>
            pairs; ///< keys of pairs of segments, the same pair perhaps several times
    };

    void test_section(const HairView& hair, std::uint32_t section, Found& found) const;
    void test_axes(const HairView& hair, std::size_t a_index, Found& found) const;
    bool slender(std::size_t segment_index) const;
    void count_pairs();
    void classify(const HairView& hair, WispContact& contact, const WispContact* earlier) const;
    void classify_all(const HairView& hair, Threads& threads);

    WispContactDesc desc_;
    Ablation ablation_;
    float sine_parallel_, sine_parallel_leaving_, tangent_, tangent_leaving_, sine_fade_;
    ContactGeometry geometry_;
    SegmentGrid grid_;
    std::vector<Found> chunks_;
    std::vector<WispContact> contacts_, earlier_;
    std::vector<std::uint64_t> pairs_;
    std::uint64_t intersecting_pairs_ = 0;
};

/// The direction of a wisp at a contact's point, and the velocity of that point.
struct ContactSide {
    Vec3 direction;
    Vec3 velocity;
};
ContactSide point_side(const HairView& hair, const WispContact& contact);
ContactSide segment_side(const HairView& hair, const WispContact& contact);

} // namespace mane
