#pragma once

#include "base/bins.h"
#include "base/parallel_for.h"
#include "interactions/box_tree.h"
#include "interactions/segments.h"
#include "interactions/wisp_contact.h"
#include "mane/desc.h"
#include "model/ablation.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// Finds the contacts between wisps, and of a wisp with itself (§4.1, M21–M23).
class WispDetection {
  public:
    /// `instruction_set`: "" for the machine's best.
    explicit WispDetection(const WispContactDesc& desc, const Ablation& ablation = {},
                           const std::string& instruction_set = "");

    /// Finds all contacts anew, in order. A contact that was there at the last call keeps its kind
    /// within the hysteresis.
    void detect(const HairView& hair, Threads& threads);

    std::span<const WispContact> contacts() const { return contacts_; }
    /// Pairs of segments of which one has a point inside the other, at the last call: the paper's
    /// intersections, each once.
    std::uint64_t intersecting_pairs() const { return intersecting_pairs_; }

  private:
    /// Two segments of which one has a point inside the other.
    struct Pair {
        std::uint32_t lower = 0, higher = 0;

        static Pair of(std::uint32_t a, std::uint32_t b) {
            return {std::min(a, b), std::max(a, b)};
        }
    };
    /// What a chunk of segments found.
    struct Found {
        std::vector<WispContact> contacts; ///< by segment
        std::vector<Pair> pairs;           ///< the same perhaps several times
        std::vector<std::uint32_t> candidates;
        std::vector<PointInside> inside;
    };

    void test_points(const HairView& hair, std::size_t segment_index, Found& found) const;
    struct Belongs {
        bool before = false, after = false;
    };
    Belongs belongs_to(const HairView& hair, std::uint32_t section, std::uint32_t segment) const;
    void arrange(const HairView& hair);
    void find_slender();
    std::span<const std::uint32_t> overlapping(const BoxTree& tree, const Box& box,
                                               Found& found) const;
    void test_axes(const HairView& hair, std::size_t a_index, Found& found) const;
    bool slender(std::size_t segment_index) const;
    void sort_contacts(const HairView& hair);
    void count_pairs();
    void classify(const HairView& hair, WispContact& contact, const WispContact* earlier) const;
    void classify_all(const HairView& hair, Threads& threads);

    WispContactDesc desc_;
    Ablation ablation_;
    float sine_parallel_, sine_parallel_leaving_, tangent_, tangent_leaving_, sine_fade_;
    ContactGeometry geometry_;
    PointTest point_test_;
    BoxTree section_tree_, segment_tree_; ///< of the sections' points, of the segments
    bool any_slender_ = false;
    std::vector<Found> chunks_;
    std::vector<WispContact> contacts_, earlier_;
    Bins places_; ///< scratch, for sorting: of each section's points
    Bins lower_;  ///< scratch, for counting pairs: by their lower segments
    std::vector<std::uint32_t> higher_, met_;
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
