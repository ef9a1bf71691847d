#pragma once

#include "interactions/impulse.h"
#include "interactions/wisp_contact.h"
#include "mane/desc.h"

namespace mane {

/// What one section brings into a contact: how much of its mass this contact may use (M27a).
struct ContactEnd {
    const SectionMass* mass = nullptr;
    float share = 0; ///< of 1/T: the square of its weight in the relative velocity, over its part
};

/// All that (W + Z)⁻¹ of a contact depends on.
struct ContactInput {
    ContactEnd ends[4]; ///< of the point (the second for axis contacts only), then of the segment
    Vec3 half_line;     ///< of an envelope point
    float envelope = 0; ///< of an envelope point: 1/m over its part; else 0
    bool friction = false;
    float density = 1;
    Vec3 point_direction, segment_direction; ///< σ_p, σ_s
};

/// The answer of contacts to a relative velocity, per unit of it (docs/model.md, "Each contact is
/// one impulse"). In double: viscosity and the light envelope points make inverse masses that
/// differ by a factor of ten thousand between directions, and the weak direction's digits must
/// survive the strong one's.
class ContactMatrix {
  public:
    /// For answers over `step` [s].
    ContactMatrix(const WispContactDesc& desc, float step);

    /// (W + Z)⁻¹; zero where nothing could move.
    Symmetric3d impulse_per_velocity(const ContactInput& input) const;

  private:
    Symmetric3d viscosity(const ContactInput& input, double mean) const;
    double dragged(float density) const;
    double sliding_weight(double sine_of_angle) const;

    double friction_; ///< the drag of density 1 over the step
    double sine_fade_;
    double sine_full_, sine_none_; ///< wisps slide in full under the one, not at all over the other
};

} // namespace mane
