#pragma once

#include "base/parallel_for.h"
#include "interactions/axis_search.h"
#include "interactions/contact_list.h"
#include "interactions/point_test.h"
#include "mane/desc.h"
#include "model/ablation.h"

#include <array>
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

    /// From the next call on, contacts are as `desc` asks.
    void change(const WispContactDesc& desc);
    /// No contact was there at the last call.
    void forget();

    /// Finds all contacts anew, for points with velocities of now. A contact that was there at the
    /// last call keeps its kind within the hysteresis. `count_pairs`: whether intersecting_pairs()
    /// is asked for.
    void detect(const HairView& hair, const ContactPoints& points, Threads& threads,
                bool count_pairs = true);

    /// Segment by segment, contacts of points in the order of places, bunch by bunch, those of axes
    /// in the order of ranks: nothing depends on how they were found.
    const ContactList& list() const { return list_; }
    /// Of the contacts, those of quasi-parallel wisps.
    std::uint64_t friction_contacts() const { return friction_contacts_; }
    /// Pairs of segments of which one has a point inside the other, at the last call: the paper's
    /// intersections, each once. 0 if they were not counted.
    std::uint64_t intersecting_pairs() const { return intersecting_pairs_; }

  private:
    /// What slides in the segments of a chunk, points by their places or axes by their ranks: all
    /// that the next detection asks of this one.
    struct Sliding {
        std::vector<std::uint32_t> number; ///< segment by segment, rising in each
        std::vector<std::uint32_t> first;  ///< per segment of the chunk
        std::span<const std::uint32_t> of(std::size_t segment) const;
        void clear();
        void begin_segment() { first.push_back(static_cast<std::uint32_t>(number.size())); }
    };
    /// What a chunk of segments found, beside the points in the list.
    struct Found {
        std::vector<WispContact> axes;
        std::vector<std::uint32_t>
            met; ///< by segment, in whole fours: those that have a point inside it
        Sliding points, earlier_points; ///< now and at the last call
        Sliding along, earlier_along;   ///< axes
        std::uint64_t pairs = 0;
    };
    /// What a thread keeps from chunk to chunk.
    struct Scratch {
        NearBoxes near; ///< bunches near a group of segments
        /// Per segment of the group.
        std::array<PointsInside, kLanes> inside;
        std::vector<std::uint32_t> slender;                  ///< ranks of those that are
        std::array<std::vector<std::uint32_t>, kLanes> axes; ///< per slender one: that it may meet
        std::vector<std::uint8_t> has_met;                   ///< by the present segment
        std::vector<PointContact> contacts;                  ///< of the present chunk
        std::vector<std::size_t> counts;                     ///< per segment of it: of those
    };
    struct Belongs {
        bool before = false, after = false;
    };

    void list_segments(const HairView& hair, const ContactPoints& points);
    void place_boxes(const ContactPoints& points, Threads& threads);
    void place_axes(const ContactPoints& points, Threads& threads);
    void begin_chunks();
    void find_chunk(const HairView& hair, const ContactPoints& points, std::size_t chunk);
    void search(const ContactPoints& points, std::span<const std::uint32_t> group,
                Scratch& scratch) const;
    void take_points(const ContactPoints& points, std::size_t index, PointsInside& inside,
                     Found& found, Scratch& scratch);
    Belongs belongs_to(const ContactPoints& points, std::uint32_t at, std::uint32_t rank) const;
    void meet(const ContactPoints& points, const Belongs& belongs, std::uint32_t at, Found& found,
              Scratch& scratch) const;
    bool slender(const ContactPoints& points, std::uint32_t rank) const {
        return points.slenderness[rank] > desc_.axis_contact_ratio;
    }
    void take_axis(const HairView& hair, const ContactPoints& points, std::uint32_t rank,
                   std::uint32_t other, Found& found) const;
    bool slid_along(std::uint32_t rank, std::uint32_t other) const;
    bool slides_along(const ContactPoints& points, const WispContact& contact, bool slid) const;
    void collect();
    void keep(const Scratch& scratch, std::size_t chunk);
    void count_pairs(std::size_t chunk);
    std::span<const std::uint32_t> met_by(std::size_t index) const;

    WispContactDesc desc_;
    Ablation ablation_;
    ParallelLimits limits_;
    PointTest point_test_;
    AxisSearch axis_search_;

    std::vector<std::uint32_t> segments_; ///< ranks at which simulated segments begin
    std::vector<Box> hulls_;
    BoxTree bunch_tree_;            ///< of the points of each bunch
    AlignedVector<AxisBunch> axes_; ///< per bunch; where any is slender
    BoxTree axes_tree_;             ///< of their boxes

    std::vector<Found> chunks_;
    ContactList list_;
    std::vector<std::uint32_t> index_;     ///< per rank: of its segment
    std::vector<std::uint32_t> first_met_; ///< per segment: in its chunk's `met`
    bool counts_pairs_ = true;
    std::uint64_t friction_contacts_ = 0;
    std::uint64_t intersecting_pairs_ = 0;
};

} // namespace mane
