// §3.3: the springs of a cross-section, and what they and the skeleton's springs do to its
// velocities, sixteen wisps at a time; docs/model.md, "Layer 2".
#if defined(MANE_STEP_ENVELOPE_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_ENVELOPE_FORCES_INL_H
#undef MANE_STEP_ENVELOPE_FORCES_INL_H
#else
#define MANE_STEP_ENVELOPE_FORCES_INL_H
#endif

#include "step/packet_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// The envelope points of a section. `kFixed` of them, or as many as the data says where it is 0:
/// four, the paper's, lie on the axes, and their cosines and sines are 0 and ±1.
template <int kFixed> struct Ring {
    static constexpr int kMost = kFixed ? kFixed : static_cast<int>(kMaxEnvelopePoints);
    const std::vector<HalfLine>& half_lines;

    /// One number per point.
    struct Numbers {
        Pack of[kMost];
        HWY_INLINE Pack& operator[](int k) { return of[k]; }
        HWY_INLINE const Pack& operator[](int k) const { return of[k]; }
    };

    HWY_INLINE int points() const { return kFixed ? kFixed : static_cast<int>(half_lines.size()); }
    HWY_INLINE int next(int k) const { return k + 1 < points() ? k + 1 : 0; }
    HWY_INLINE int last(int k) const { return k > 0 ? k - 1 : points() - 1; }

    HWY_INLINE Numbers load(const float* row) const {
        Numbers n;
        for (int k = 0; k < points(); ++k)
            n[k] = Pack::load(row + k * kLanes);
        return n;
    }
    HWY_INLINE void store(const Numbers& n, float* row) const {
        for (int k = 0; k < points(); ++k)
            n[k].store(row + k * kLanes);
    }
    HWY_INLINE Pack sum(const Numbers& n) const {
        Pack s = n[0];
        for (int k = 1; k < points(); ++k)
            s = s + n[k];
        return s;
    }
    /// Sum of vectors along the half lines.
    HWY_INLINE Pack2 sum_in_plane(const Numbers& n) const {
        if constexpr (kFixed == 4)
            return {n[0] - n[2], n[1] - n[3]};
        Pack2 s{Pack(0.f), Pack(0.f)};
        for (int k = 0; k < points(); ++k)
            s = s + Pack2{cosine(k), sine(k)} * n[k];
        return s;
    }
    /// `a` less the part of a vector along half line k.
    HWY_INLINE Pack less(Pack a, int k, Pack2 vector) const {
        if constexpr (kFixed == 4) {
            const Pack part = k % 2 == 0 ? vector.u : vector.v;
            return k < 2 ? a - part : a + part;
        }
        return a - dot(vector, Pack2{cosine(k), sine(k)});
    }

    /// Sums of the forces of all springs along the half lines.
    HWY_INLINE Numbers springs(const float* rest, const Numbers& radius,
                               const Numbers& rate) const {
        const Numbers length = ring_lengths(radius); // first, for roots take longest
        Numbers force = radial_springs(rest, radius, rate);
        const Numbers tension = ring_tensions(rest, length, radius, rate);
        for (int k = 0; k < points(); ++k) {
            const int l = last(k), n = next(k);
            force[k] = force[k] - (tension[k] + tension[l]) * radius[k];
            if constexpr (kFixed != 4)
                force[k] = force[k] + cosine(1) * (tension[k] * radius[n] + tension[l] * radius[l]);
        }
        return force;
    }

  private:
    /// M11: ½ k₀ r⁰ (1/ρ − ρ), and a damper.
    HWY_INLINE Numbers radial_springs(const float* rest, const Numbers& radius,
                                      const Numbers& rate) const {
        const Pack half_stiffness = rest_value(rest, Rest::half_radial),
                   damping = rest_value(rest, Rest::radial_damping);
        const Numbers r0 = load(rest + RestRows::kColumns * kLanes);
        Numbers r, force;
        for (int k = 0; k < points(); ++k)
            r[k] = larger(radius[k], r0[k] * Pack(0.15f));
        const Numbers inverse = reciprocals(r);
        for (int k = 0; k < points(); ++k)
            force[k] = half_stiffness * (r0[k] * r0[k] * inverse[k] - r[k]) - damping * rate[k];
        return force;
    }

    /// M12: of the spring between k and k + 1.
    HWY_INLINE Numbers ring_lengths(const Numbers& radius) const {
        Numbers length;
        for (int k = 0; k < points(); ++k) {
            const Pack here = radius[k], there = radius[next(k)];
            Pack squared = here * here + there * there;
            if constexpr (kFixed != 4)
                squared = squared - cosine(1) * (here * there + here * there);
            length[k] = square_root(larger(squared, Pack(1e-12f)));
        }
        return length;
    }
    /// Over its length: it pulls at r_k with r_k − C r_{k+1} times that, and the other way round.
    HWY_INLINE Numbers ring_tensions(const float* rest, const Numbers& length,
                                     const Numbers& radius, const Numbers& rate) const {
        const Pack stiffness = rest_value(rest, Rest::ring),
                   damping = rest_value(rest, Rest::ring_damping);
        const Numbers at_rest =
            load(rest + (RestRows::kColumns + static_cast<std::uint32_t>(points())) * kLanes);
        const Numbers inverse = reciprocals(length);
        Numbers tension;
        for (int k = 0; k < points(); ++k) {
            const int n = next(k);
            Pack growth = radius[k] * rate[k] + radius[n] * rate[n]; // length times its rate
            if constexpr (kFixed != 4)
                growth = growth - cosine(1) * (radius[k] * rate[n] + radius[n] * rate[k]);
            tension[k] = stiffness + (damping * growth * inverse[k] - at_rest[k]) * inverse[k];
        }
        return tension;
    }

    HWY_INLINE Numbers reciprocals(const Numbers& x) const {
        if constexpr (kFixed == 4) {
            const FourReciprocals four(x[0], x[1], x[2], x[3]);
            return {{four.of[0], four.of[1], four.of[2], four.of[3]}};
        } else {
            Numbers inverse;
            for (int k = 0; k < points(); ++k)
                inverse[k] = Pack(1.f) / x[k];
            return inverse;
        }
    }
    HWY_INLINE Pack cosine(int k) const { return Pack(half_lines[k].cosine); }
    HWY_INLINE Pack sine(int k) const { return Pack(half_lines[k].sine); }
};

/// The forces of section i's envelope springs.
template <int kFixed>
HWY_INLINE void squeeze_envelope(const PacketRows& rows, std::size_t i, const Ring<kFixed>& ring) {
    ring.store(
        ring.springs(rows.rest[i], ring.load(rows.radius[i]), ring.load(rows.radius_rate[i])),
        rows.scratch(i, Scratch::springs));
}

/// What a step does alike to all sections.
struct StepPacks {
    Pack h, drag, kept; ///< [s], [1/s] of the air's resistance, what that leaves of a velocity
    Pack3 gravity, in_uniform_air;
    bool uniform, reaction;

    HWY_INLINE explicit StepPacks(const KernelData& data)
        : h(data.step), drag(data.drag), kept(1 - data.step * data.drag),
          gravity(broadcast(data.gravity)),
          in_uniform_air((gravity + broadcast(data.uniform_wind) * drag) * h),
          uniform(data.wind == nullptr), reaction(data.ablation.reaction) {}

    /// What gravity and the air's velocity add to that of every point of a section.
    HWY_INLINE Pack3 free(const PacketRows& rows, std::size_t i) const {
        return uniform ? in_uniform_air : (gravity + Pack3::load(rows.wind[i]) * drag) * h;
    }
};

/// Velocities of section i's skeleton point and envelope points from all forces (M9, M13).
template <int kFixed> HWY_INLINE void accelerate_section(const PacketRows& rows, std::size_t i,
                                                         const StepPacks& step,
                                                         const Ring<kFixed>& ring) {
    const float* rest = rows.rest[i];
    const SectionAxes axes = rows.axes(i);
    const Pack3 force = Pack3::load(rows.scratch(i, Scratch::force));
    const auto springs = ring.load(rows.scratch(i, Scratch::springs));
    Pack2 across = axes.in_plane(force);
    if (step.reaction)
        across = across - ring.sum_in_plane(springs);
    const Pack inverse_mass = rest_value(rest, Rest::inverse_mass_across);
    across = across * (inverse_mass * step.h); // a velocity from here on
    const Pack along = dot(force, axes.normal) *
                       ((inverse_mass + rest_value(rest, Rest::inverse_mass_extra)) * step.h);

    const Pack inverse_envelope_mass = rest_value(rest, Rest::inverse_envelope_mass);
    const Pack3 free = select_or_zero(inverse_envelope_mass > Pack(0.f), step.free(rows, i));
    float* velocity = rows.velocity[i];
    without_tiny(Pack3::load(velocity) * step.kept + free + axes.in_space(across, along))
        .store(velocity);

    const Pack pushed = inverse_envelope_mass * step.h;
    float* rates = rows.radius_rate[i];
    for (int k = 0; k < ring.points(); ++k) {
        float* rate = rates + k * kLanes;
        without_tiny(ring.less(Pack::load(rate) * step.kept + springs[k] * pushed, k, across))
            .store(rate);
    }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
