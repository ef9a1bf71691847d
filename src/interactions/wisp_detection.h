#pragma once

#include "base/bins.h"
#include "base/parallel_for.h"
#include "interactions/point_test.h"
#include "interactions/wisp_contact.h"
#include "mane/desc.h"
#include "model/ablation.h"

#include <span>
#include <string>
#include <vector>

namespace mane {

/// Finds the contacts between wisps (§4.1): a tree of boxes instead of the paper's grid, then
/// points in volumes (M21, M22), then what kind of contact each is (M23).
class WispDetection {
  public:
    /// `instruction_set`: "" for the machine's best.
    explicit WispDetection(const WispContactDesc& desc, const Ablation& ablation = {},
                           const std::string& instruction_set = "");

    /// Finds all contacts anew, for points with velocities of now. A contact that was there at the
    /// last call keeps its kind within the hysteresis.
    void detect(const HairView& hair, const ContactPoints& points, Threads& threads);

    /// Contacts of points, segment by segment in the order of ranks, then contacts of axes: nothing
    /// depends on how they were found.
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
        std::vector<WispContact> contacts; ///< of points
        std::vector<WispContact> axes;
        std::vector<Pair> pairs; ///< the same perhaps several times
        NearBoxes near;          ///< bunches of points near a group of segments
        NearBoxes near_axes;     ///< bunches of segments near it
        std::vector<std::uint32_t> bunches;
        PointsInside inside;
    };
    struct Belongs {
        bool before = false, after = false;
    };

    void list_segments(const HairView& hair, const ContactPoints& points);
    void place_boxes(const ContactPoints& points, Threads& threads);
    void place_axes(const ContactPoints& points, Threads& threads);
    void find_chunk(const HairView& hair, const ContactPoints& points, std::size_t chunk);
    void gather_near(const ContactPoints& points, std::size_t first, std::size_t last,
                     Found& found) const;
    std::size_t find_points(const HairView& hair, const ContactPoints& points, std::size_t index,
                            Found& found) const;
    Belongs belongs_to(const HairView& hair, std::uint32_t section, std::uint32_t segment) const;
    void count_pair(const Belongs& belongs, std::uint32_t section, std::uint32_t segment,
                    Found& found) const;
    bool slender(const ContactPoints& points, std::uint32_t rank) const {
        return points.slenderness[rank] > desc_.axis_contact_ratio;
    }
    void find_axes(const HairView& hair, const ContactPoints& points, std::uint32_t rank,
                   Found& found) const;
    void find_axis(const HairView& hair, const ContactPoints& points, std::uint32_t rank,
                   std::uint32_t other, Found& found) const;
    WispContactKind axis_kind(const ContactPoints& points, const WispContact& contact) const;
    void collect(const ContactPoints& points, Threads& threads);
    void count_pairs(std::size_t sections);

    WispContactDesc desc_;
    Ablation ablation_;
    ParallelLimits limits_;
    PointTest point_test_;

    std::vector<std::uint32_t> segments_; ///< ranks at which simulated segments begin
    std::vector<Box> hulls_;
    BoxTree bunch_tree_;                         ///< of the points of each bunch
    AlignedVector<BoxTree::Node> segment_boxes_; ///< per bunch; where any is slender
    BoxTree segment_tree_;                       ///< of those
    bool any_slender_ = false;

    std::vector<Found> chunks_;
    std::vector<WispContact> contacts_, earlier_;
    std::size_t axes_ = 0, earlier_axes_ = 0;          ///< where contacts of axes begin
    std::vector<std::uint32_t> first_, earlier_first_; ///< per segment and one more
    Bins lower_; ///< scratch, for counting pairs: by their lower segments
    std::vector<std::uint32_t> higher_, met_;
    std::uint64_t intersecting_pairs_ = 0;
};

} // namespace mane
