#include "groom/stability.h"

#include "base/functions.h"
#include "groom/matrix.h"
#include "mane/error.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace mane {
namespace {

constexpr double kLeastRatio = 0.15; // ρ under which a radial spring stiffens no more
constexpr double kThickest = 4;      // cap of the thickness factor of bending

// What pulls a wisp together, each by one parameter. The first of each pair is a stiffness, the
// second a damping.
enum Term {
    stretch,
    stretch_damping,
    bend,
    bend_damping,
    radial,
    radial_damping,
    ring,
    ring_damping,
    drag_term,
    terms
};
constexpr std::array<const char*, terms> kParameter = {
    "skeleton.strain",          "skeleton.stretch_damping", "skeleton.bending_length",
    "skeleton.bending_damping", "envelope.squeeze",         "envelope.damping",
    "envelope.ring_stiffness",  "envelope.ring_damping",    "air.drag"};
constexpr bool is_damping(int term) {
    return term % 2 == 1 || term == drag_term;
}

// One wisp stretched out along its third axis. Degrees of freedom per simulated section: the
// skeleton point x, then for each envelope point y_k = r_k + d_k·x, in which the kinetic energy is
// diagonal (docs/model.md, "Coupling").
class StraightSystem {
  public:
    StraightSystem(const Groom& groom, std::size_t wisp, double drag)
        : groom_(groom), first_(groom.first_section[wisp]), sections_(groom.sections(wisp)),
          points_(groom.envelope_points), mass_(size()), term_(terms, Matrix(size())) {
        add_masses(drag);
        for (std::size_t i = 1; i + 1 < sections_; ++i) {
            add_stretch(i);
            add_bend(i);
        }
        for (std::size_t i = 2; i < sections_; ++i) {
            add_radial(i);
            add_ring(i);
        }
    }

    // Whether steps of h are stable with all terms, or with one alone.
    bool holds(double h) const { return holds(h, 0, terms); }
    bool holds(double h, int term) const { return holds(h, term, term + 1); }

  private:
    // A linear combination of a few degrees of freedom, whose square is an energy.
    struct Part {
        std::size_t freedom;
        double weight;
    };
    using Parts = std::vector<Part>;

    std::size_t freedoms() const { return 3 + points_; }
    std::size_t size() const { return (sections_ - 2) * freedoms(); }
    std::size_t band() const { return 3 * freedoms(); } // a joint's three sections
    std::size_t point(std::size_t i, std::size_t axis) const { return (i - 2) * freedoms() + axis; }

    // The kinematic sections do not move: their parts are left out.
    void skeleton_part(Parts& parts, std::size_t i, std::size_t axis, double weight) const {
        if (i >= 2)
            parts.push_back({point(i, axis), weight});
    }
    // r_k = y_k − d_k·x
    void radius_part(Parts& parts, std::size_t i, std::size_t k, double weight) const {
        const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(points_);
        parts.push_back({point(i, 3 + k), weight});
        parts.push_back({point(i, 0), -weight * cosine(angle)});
        parts.push_back({point(i, 1), -weight * sine(angle)});
    }
    void add(int term, const Parts& parts, double factor) {
        for (const Part& a : parts)
            for (const Part& b : parts)
                term_[term].at(a.freedom, b.freedom) += factor * a.weight * b.weight;
    }

    void add_masses(double drag) {
        for (std::size_t i = 2; i < sections_; ++i) {
            const double envelope = groom_.envelope_mass[first_ + i];
            // Across the section half of the envelope points' mass takes part, along it all of it.
            // A joint bent by 60° turns its section by 30° from the segments beside it: a segment's
            // direction then has ¾ of one and ¼ of the other.
            const double across =
                groom_.skeleton_mass[first_ + i] + envelope * static_cast<double>(points_) / 2;
            const double normal =
                groom_.skeleton_mass[first_ + i] + envelope * static_cast<double>(points_);
            const double along = 1 / (0.75 / normal + 0.25 / across);
            for (std::size_t f = 0; f < freedoms(); ++f) {
                const double m = f == 2 ? along : f < 2 ? across : envelope;
                mass_[point(i, f)] = m;
                term_[drag_term].at(point(i, f), point(i, f)) = drag * m;
            }
        }
    }
    void add_stretch(std::size_t i) {
        const std::size_t s = first_ + i;
        Parts parts;
        skeleton_part(parts, i, 2, -1);
        skeleton_part(parts, i + 1, 2, 1);
        add(stretch, parts, double{groom_.stretch_stiffness[s]} / groom_.rest_length[s]);
        add(stretch_damping, parts, groom_.stretch_damping[s]);
    }
    void add_bend(std::size_t i) {
        const std::size_t s = first_ + i;
        const double before = 1 / double{groom_.rest_length[s - 1]},
                     after = 1 / double{groom_.rest_length[s]};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            Parts parts;
            skeleton_part(parts, i - 1, axis, before);
            skeleton_part(parts, i, axis, -before - after);
            skeleton_part(parts, i + 1, axis, after);
            add(bend, parts, kThickest * groom_.bend_stiffness[s]);
            add(bend_damping, parts, groom_.bend_damping[s]);
        }
    }
    void add_radial(std::size_t i) {
        const double slope = 0.5 * (1 / (kLeastRatio * kLeastRatio) + 1);
        for (std::size_t k = 0; k < points_; ++k) {
            Parts parts;
            radius_part(parts, i, k, 1);
            add(radial, parts, slope * groom_.radial_stiffness[first_ + i]);
            add(radial_damping, parts, groom_.radial_damping[first_ + i]);
        }
    }
    void add_ring(std::size_t i) {
        const double share = sine(kPi / static_cast<double>(points_)); // of ṙ in ḋ, for equal radii
        for (std::size_t k = 0; k < points_; ++k) {
            Parts parts;
            radius_part(parts, i, k, share);
            radius_part(parts, i, (k + 1) % points_, share);
            add(ring, parts, groom_.ring_stiffness[first_ + i]);
            add(ring_damping, parts, groom_.ring_damping[first_ + i]);
        }
    }

    bool holds(double h, int first_term, int last_term) const {
        Matrix left(size());
        for (std::size_t a = 0; a < size(); ++a) {
            left.at(a, a) = 4 * mass_[a];
            const std::size_t from = a > band() ? a - band() : 0;
            for (int t = first_term; t < last_term; ++t) {
                const double factor = is_damping(t) ? 2 * h : h * h;
                for (std::size_t b = from; b <= a; ++b)
                    left.at(a, b) -= factor * term_[t].at(a, b);
            }
        }
        return is_positive_definite(std::move(left), band());
    }

    const Groom& groom_;
    std::size_t first_, sections_, points_;
    std::vector<double> mass_;
    std::vector<Matrix> term_;
};

// The largest h under `from` for which `holds`, to a part in 10⁴; 0 if none over a nanosecond.
template <typename Holds> double largest_step(double from, Holds&& holds) {
    double low = 1e-9, high = from;
    if (!holds(low))
        return 0;
    while (high > low * 1.0001) {
        const double middle = std::sqrt(low * high);
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

constexpr double kLongest = 10; // [s] more is never asked for

const char* most_limiting_parameter(const StraightSystem& system) {
    double least = std::numeric_limits<double>::infinity();
    int found = 0;
    for (int t = 0; t < terms; ++t) {
        const double limit = largest_step(kLongest, [&](double h) { return system.holds(h, t); });
        if (limit < least)
            least = limit, found = t;
    }
    return kParameter[found];
}

} // namespace

StepLimit step_limit(const Groom& groom, double drag) {
    StepLimit limit{kLongest, 0, ""};
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const StraightSystem system(groom, w, drag);
        if (system.holds(limit.step))
            continue; // does not limit more than one before
        limit.step = largest_step(limit.step, [&](double h) { return system.holds(h); });
        limit.wisp = w;
    }
    if (groom.wisp_count() > 0)
        limit.parameter = most_limiting_parameter(StraightSystem(groom, limit.wisp, drag));
    return limit;
}

void require_stable_step(const Groom& groom, double drag, double step) {
    bool stable = true; // asked alone, for a world that is changed while it runs
    for (std::size_t w = 0; w < groom.wisp_count() && stable; ++w)
        stable = StraightSystem(groom, w, drag).holds(step);
    if (stable)
        return;
    const StepLimit limit = step_limit(groom, drag);
    throw InputError("wisp " + std::to_string(limit.wisp) + ": steps of " +
                     std::to_string(step * 1e3) + " ms are unstable, mostly by " + limit.parameter +
                     "; the largest stable step is " + std::to_string(limit.step * 1e3) +
                     " ms (schedule.integration_rate = " +
                     std::to_string(static_cast<long>(std::ceil(1 / limit.step))) + ")");
}

} // namespace mane
