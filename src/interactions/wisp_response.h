#pragma once

#include "interactions/contact_geometry.h"
#include "interactions/contact_list.h"
#include "interactions/wisp_answers.h"
#include "mane/contact.h"
#include "mane/desc.h"

#include <span>
#include <string>
#include <vector>

namespace mane {

/// Velocity modifications for contacts between wisps (§4.1, M24–M28): every contact is one impulse
/// between its point and the two ends of its segment, from the same frozen velocities; then each
/// section gathers what concerns it. The result depends neither on the order of contacts (but for
/// rounding) nor on threads.
///
/// Called at three rates: `engage` when contacts were found, `prepare` at the beginning of each
/// detection block, `apply` at every step. Answered less often than every step, friction would let
/// wisps that rest on each other fall in between and shake.
class WispResponse {
  public:
    /// `instruction_set`: "" for the machine's best.
    explicit WispResponse(const WispContactDesc& desc, const std::string& instruction_set = "");

    /// From the next `prepare` on, contacts are answered as `desc` asks.
    void change(const WispContactDesc& desc);

    /// From the next `engage` on, masses are those of the hair then: sections were pinned or
    /// released, or have other masses.
    void forget_masses() { answers_.inverse_mass.clear(); }

    /// Takes the contacts of a detection, which must outlive the next call: they stay engaged until
    /// then (M36).
    void engage(const HairView& hair, ContactGeometry& geometry, const ContactList& list,
                Threads& threads);

    /// Finds how contacts answer in the steps to come, each of `step` [s], by the directions that
    /// `geometry` took.
    void prepare(const ContactGeometry& geometry, float step, Threads& threads);

    /// Changes `velocity` and `radius_rate` of `state` for one step.
    void apply(const HairView& hair, ContactGeometry& geometry, State& state, Threads& threads);

    /// Adds the engaged contacts with their impulses of the last step, in the order of their
    /// points.
    void list(const HairView& hair, const ContactOrder& order,
              std::vector<Contact>& contacts) const;

  private:
    void take_masses(const HairView& hair, const ContactOrder& order);
    void lay_out_slots(const ContactOrder& order);
    void fill_segment(const ContactPoints& points, std::uint32_t rank);
    void fill_up(std::uint32_t slot, std::uint32_t end);
    void take_axis_points(const ContactPoints& points);
    void sort_by_section(const ContactPoints& points, Threads& threads);
    void sort_axes(const ContactOrder& order);
    void share_mass(const ContactPoints& points, std::uint32_t rank);
    void take_axis_velocities(ContactGeometry& geometry) const;

    WispAnswers answers_;
    WispAnswerKernels kernels_;
    const ContactList* list_ = nullptr; ///< of the last detection
    Bins axes_of_;                      ///< per rank: the axis contacts of its segment
    std::vector<std::uint32_t> by_segment_;
    std::vector<float> on_segment_; ///< per rank: the weights of its segment's contacts
};

} // namespace mane
