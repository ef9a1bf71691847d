// §3.3: the springs of a cross-section, and what they and the skeleton's springs do to its
// velocities, sixteen wisps at a time; docs/model.md, "Layer 2".
#if defined(MANE_STEP_ENVELOPE_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_ENVELOPE_FORCES_INL_H
#undef MANE_STEP_ENVELOPE_FORCES_INL_H
#else
#define MANE_STEP_ENVELOPE_FORCES_INL_H
#endif

#include "step/kernels.h"
#include "step/skeleton_forces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// The envelope of one section. `kFixed` points, or as many as the data says where it is 0: four,
/// the paper's, lie on the axes, and their cosines and sines are 0 and ±1.
template <int kFixed> struct Ring {
    static constexpr int kMost = kFixed ? kFixed : static_cast<int>(kMaxEnvelopePoints);
    const KernelData& data;
    Pack radius[kMost], rate[kMost], force[kMost];

    HWY_INLINE int points() const {
        return kFixed ? kFixed : static_cast<int>(data.half_lines.size());
    }
    HWY_INLINE int next(int k) const { return k + 1 < points() ? k + 1 : 0; }

    HWY_INLINE Ring(const KernelData& d, std::size_t row, std::size_t lane) : data(d) {
        for (int k = 0; k < points(); ++k) {
            radius[k] = Pack::load(data.state.radius.row(row) + k * kLanes + lane);
            rate[k] = Pack::load(data.state.radius_rate.row(row) + k * kLanes + lane);
        }
    }

    /// M11: ½ k₀ r⁰ (1/ρ − ρ), and a damper.
    HWY_INLINE void add_radial_springs(const float* rest) {
        const Pack stiffness = rest_value(rest, Rest::radial) * Pack(0.5f),
                   damping = rest_value(rest, Rest::radial_damping);
        Pack r0[kMost], r[kMost], inverse[kMost];
        for (int k = 0; k < points(); ++k) {
            r0[k] = Pack::load(rest + (RestRows::kColumns + k) * kLanes);
            r[k] = larger(larger(radius[k], r0[k] * Pack(0.15f)), Pack(1e-9f));
        }
        reciprocals(r, inverse);
        for (int k = 0; k < points(); ++k)
            force[k] = stiffness * (r0[k] * r0[k] * inverse[k] - r[k]) - damping * rate[k];
    }

    /// M12.
    HWY_INLINE void add_ring_springs(const float* rest) {
        const Pack ring = rest_value(rest, Rest::ring),
                   damping = rest_value(rest, Rest::ring_damping);
        Pack a[kMost], b[kMost], length[kMost], inverse[kMost];
        for (int k = 0; k < points(); ++k) {
            const Pack here = radius[k], there = radius[next(k)];
            a[k] = kFixed == 4 ? here : here - cosine(1) * there;
            b[k] = kFixed == 4 ? there : there - cosine(1) * here;
            length[k] = square_root(larger(a[k] * here + b[k] * there, Pack(1e-12f)));
        }
        reciprocals(length, inverse);
        for (int k = 0; k < points(); ++k) {
            const Pack length_rate = (a[k] * rate[k] + b[k] * rate[next(k)]) * inverse[k];
            const Pack rest_length =
                Pack::load(rest + (RestRows::kColumns + points() + k) * kLanes);
            const Pack tension =
                (ring * (length[k] - rest_length) + damping * length_rate) * inverse[k];
            force[k] = force[k] - tension * a[k];
            force[next(k)] = force[next(k)] - tension * b[k];
        }
    }

    /// Sum of the forces along the section's first and second axis.
    HWY_INLINE void reaction(Pack& along_u, Pack& along_v) const {
        if constexpr (kFixed == 4) {
            along_u = force[0] - force[2];
            along_v = force[1] - force[3];
        } else {
            along_u = along_v = Pack(0.f);
            for (int k = 0; k < points(); ++k) {
                along_u = along_u + force[k] * cosine(k);
                along_v = along_v + force[k] * sine(k);
            }
        }
    }

    /// The part along half line k of a vector with the parts (u, v) in the section.
    HWY_INLINE Pack along(int k, Pack u, Pack v) const {
        if constexpr (kFixed == 4)
            return k == 0 ? u : k == 1 ? v : k == 2 ? -u : -v;
        return u * cosine(k) + v * sine(k);
    }

  private:
    HWY_INLINE Pack cosine(int k) const { return Pack(data.half_lines[k].cosine); }
    HWY_INLINE Pack sine(int k) const { return Pack(data.half_lines[k].sine); }
    HWY_INLINE void reciprocals(const Pack* x, Pack* inverse) const {
        if constexpr (kFixed == 4) {
            const FourReciprocals four(x[0], x[1], x[2], x[3]);
            for (int k = 0; k < 4; ++k)
                inverse[k] = four.of[k];
        } else {
            for (int k = 0; k < points(); ++k)
                inverse[k] = Pack(1.f) / x[k];
        }
    }
};

/// Velocities of a skeleton point and its envelope points from the skeleton's `force` and their own
/// springs (M9, M13).
template <int kFixed> HWY_INLINE void accelerate_section(const KernelData& data, std::size_t row,
                                                         std::size_t lane, Pack3 force,
                                                         const CurvePoint& section) {
    const float* rest = data.rest.row(row) + lane;
    Ring<kFixed> ring(data, row, lane);
    ring.add_radial_springs(rest);
    ring.add_ring_springs(rest);

    Pack reaction_u, reaction_v;
    ring.reaction(reaction_u, reaction_v);
    if (!data.ablation.reaction)
        reaction_u = reaction_v = Pack(0.f);
    const Pack3 total = force - section.u * reaction_u - section.v * reaction_v;
    const Pack3 a =
        total * rest_value(rest, Rest::inverse_mass_across) +
        section.normal * (dot(total, section.normal) * rest_value(rest, Rest::inverse_mass_extra));

    const Pack h(data.step), drag(data.drag);
    const Pack inverse_mass = rest_value(rest, Rest::inverse_envelope_mass);
    const Mask moves = inverse_mass > Pack(0.f);
    float* velocity = data.state.velocity.row(row) + lane;
    const Pack3 v = Pack3::load(velocity);
    const Pack3 air = data.wind
                          ? Pack3::load(data.wind->row(row) + lane)
                          : Pack3{data.uniform_wind.x, data.uniform_wind.y, data.uniform_wind.z};
    const Pack3 gravity{data.gravity.x, data.gravity.y, data.gravity.z};
    const Pack3 free =
        select_or_zero(moves, gravity + (air - v) * drag); // alike at every point of the section
    without_tiny(v + (free + a) * h).store(velocity);

    const Pack au = dot(a, section.u), av = dot(a, section.v);
    float* rates = data.state.radius_rate.row(row) + lane;
    for (int k = 0; k < ring.points(); ++k)
        without_tiny(ring.rate[k] +
                     (ring.force[k] * inverse_mass - drag * ring.rate[k] - ring.along(k, au, av)) *
                         h)
            .store(rates + k * kLanes);
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
