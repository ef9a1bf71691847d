#include "reference/random_groom.h"

#include "reference/random_numbers.h"

#include <algorithm>
#include <vector>

namespace mane::reference {
namespace {

constexpr double kGravity = 9.81;

/// What one wisp is made of, before it is written out by section.
struct Recipe {
    std::vector<Vec3d> x;
    double mass_per_length, mass_share;
    double strain, stretch_damping, bending_length, bending_damping;
    double squeeze, radial_damping, ring_stiffness, ring_damping;
    double radius;

    double segment(std::size_t i) const { return length(x[i + 1] - x[i]); }
    double simulated_length() const {
        double sum = 0;
        for (std::size_t i = 1; i + 1 < x.size(); ++i)
            sum += segment(i);
        return std::max(sum, 0.01);
    }
    /// Half of each neighbouring simulated segment.
    double section_mass(std::size_t i) const {
        const double before = i >= 2 ? segment(i - 1) : 0,
                     after = i >= 1 && i + 1 < x.size() ? segment(i) : 0;
        return mass_per_length * (before + after) / 2;
    }
};

/// A walk of unequal segments whose joints bend by up to `sharpest` degrees.
std::vector<Vec3d> bent_curve(RandomNumbers& random, const RandomHair& hair,
                              std::uint32_t sections) {
    const double segment = random.around(0.01, 0.05),
                 sharpest = hair.sharpest * std::numbers::pi / 180;
    Vec3d t = random.direction();
    std::vector<Vec3d> x = {random.vector(hair.spread / 2)};
    while (x.size() < sections) {
        x.push_back(x.back() + segment * random.between(0.7, 1.4) * t);
        const double angle =
            random.chance(0.2) ? random.between(0, sharpest) : random.between(0, sharpest / 3);
        t = normalized(std::cos(angle) * t + std::sin(angle) * random.across(t));
    }
    return x;
}

Recipe random_recipe(RandomNumbers& random, const RandomHair& hair) {
    Recipe w;
    w.x = bent_curve(random, hair, random.count(hair.least_sections, hair.most_sections));
    w.mass_per_length = random.around(5e-4, 2e-2);
    w.mass_share = random.between(0.1, 0.4);
    w.strain = random.around(0.005, 0.05);
    w.stretch_damping = random.between(0, 0.1);
    w.bending_length = random.around(0.02, 0.1);
    w.bending_damping = random.between(0, 0.5);
    w.squeeze = random.between(0.1, 0.4);
    w.radial_damping = random.between(0, 1);
    w.ring_stiffness = random.between(0, 0.5);
    w.ring_damping = random.between(0, 2);
    w.radius = random.around(0.004, 0.03);
    return w;
}

WispRoot random_root(RandomNumbers& random, const Recipe& w) {
    WispRoot root;
    root.barycentric = {1, 0, 0};
    root.inside = Vec3(w.x[0]);
    root.outside = Vec3(w.x[1]);
    root.first_axis = Vec3(random.across(normalized(w.x[1] - w.x[0])));
    return root;
}

void add_skeleton(RandomNumbers& random, const Recipe& w, std::size_t i, Groom& groom) {
    const auto add = [](std::vector<float>& values, double value) {
        values.push_back(static_cast<float>(value));
    };
    const double mass = w.section_mass(i), weight = w.mass_per_length * kGravity;
    add(groom.skeleton_mass, (1 - w.mass_share) * mass);
    add(groom.envelope_mass, w.mass_share * mass / groom.envelope_points);

    const double l = w.segment(std::min(i, w.x.size() - 2));
    const double EA = weight * w.simulated_length() / w.strain;
    add(groom.stretch_stiffness, EA);
    add(groom.stretch_damping, 2 * w.stretch_damping * std::sqrt(EA * w.mass_per_length));
    add(groom.rest_length, l * random.between(0.9, 1.1));

    const double stiffness = weight * std::pow(w.bending_length, 3) / l * random.between(0.5, 2);
    const double first_mode = 3.516 * std::sqrt(kGravity / w.bending_length);
    add(groom.bend_stiffness, stiffness);
    add(groom.bend_damping, 2 * w.bending_damping / first_mode * stiffness);
    add(groom.rest_curvature_u, random.between(-1, 1));
    add(groom.rest_curvature_v, random.between(-1, 1));
}

void add_envelope(RandomNumbers& random, const Recipe& w, std::size_t i, Groom& groom) {
    const double mass = std::max(w.section_mass(i), w.mass_per_length * 0.005);
    const double point = w.mass_share * mass / groom.envelope_points, kept = 1 - w.squeeze;
    const double radial = mass * kGravity / ((1 / kept - kept) / 2 * w.radius);
    const double ring = w.ring_stiffness * radial;
    groom.radial_stiffness.push_back(static_cast<float>(radial));
    groom.radial_damping.push_back(
        static_cast<float>(2 * w.radial_damping * std::sqrt(radial * point)));
    groom.ring_stiffness.push_back(static_cast<float>(ring));
    groom.ring_damping.push_back(static_cast<float>(2 * w.ring_damping * std::sqrt(ring * point)));
    const double chord = 2 * w.radius * std::sin(std::numbers::pi / groom.envelope_points);
    for (std::uint32_t k = 0; k < groom.envelope_points; ++k) {
        const double radius = w.radius * random.between(0.7, 1.4);
        groom.radius.push_back(static_cast<float>(radius));
        groom.rest_radius.push_back(static_cast<float>(radius * random.between(0.8, 1.25)));
        groom.ring_length.push_back(static_cast<float>(chord * random.between(0.8, 1.2)));
    }
}

/// Whether the joints around section i, and the planes around them, can be told apart from folded
/// ones in float.
bool unfolded(const std::vector<Vec3d>& x, std::size_t i, double sharpest) {
    const double least_cosine = std::cos(sharpest * std::numbers::pi / 180);
    const auto direction = [&](std::size_t j) { return normalized(x[j + 1] - x[j]); };
    const auto turned = [&](std::size_t a, std::size_t b) {
        return b + 1 < x.size() && dot(direction(a), direction(b)) < least_cosine;
    };
    for (std::size_t j = i < 3 ? 0 : i - 3; j <= i && j + 1 < x.size(); ++j) {
        if (turned(j, j + 1))
            return false;
        const bool vanishes = j + 2 < x.size() && length(direction(j + 1)) == 0;
        if (vanishes && turned(j, j + 2))
            return false;
    }
    return true;
}

/// Moves a point, unless that folds the wisp.
void move_point(std::vector<Vec3d>& x, std::size_t i, const Vec3d& to, double sharpest) {
    const Vec3d before = x[i];
    x[i] = to;
    if (!unfolded(x, i, sharpest))
        x[i] = before;
}

std::vector<Vec3d> moved_curve(RandomNumbers& random, const RandomHair& hair,
                               std::vector<Vec3d> x) {
    const Vec3d shift = random.vector(0.05);
    for (Vec3d& p : x)
        p += shift;
    for (std::size_t i = 1; i < x.size(); ++i)
        move_point(x, i, x[i] + random.vector(0.3 * length(x[i] - x[i - 1])), hair.sharpest);
    // A segment of no length: neither the root's nor the tip's, whose direction nothing else would
    // define.
    for (std::size_t i = 3; hair.vanishing && i + 2 < x.size(); i += 3)
        if (random.chance(0.1))
            move_point(x, i, x[i - 1], hair.sharpest);
    return x;
}

void add_state(RandomNumbers& random, const RandomHair& hair, const Groom& groom, std::size_t w,
               Frame& frame) {
    std::vector<Vec3d> x;
    for (std::size_t s = groom.first_section[w]; s < groom.first_section[w + 1]; ++s)
        x.emplace_back(groom.position[s]);
    x = moved_curve(random, hair, x);
    frame.first_axis.emplace_back(random.across(normalized(x[1] - x[0])));
    const Vec3d together = random.vector(2);
    for (std::size_t i = 0; i < x.size(); ++i) {
        frame.position.emplace_back(x[i]);
        frame.velocity.emplace_back(together + random.vector(1));
        for (std::uint32_t k = 0; k < groom.envelope_points; ++k) {
            const std::size_t at = (groom.first_section[w] + i) * groom.envelope_points + k;
            const bool zero = hair.vanishing && random.chance(0.05);
            const double radius = static_cast<double>(groom.radius[at]);
            frame.radius.push_back(zero ? 0.0f
                                        : static_cast<float>(radius * random.between(0.05, 2)));
            frame.radius_rate.push_back(i < 2 ? 0.0f
                                              : static_cast<float>(random.between(-0.5, 0.5)));
        }
    }
}

} // namespace

Groom random_groom(const RandomHair& hair) {
    RandomNumbers random(hair.seed);
    Groom groom;
    groom.envelope_points = hair.points;
    groom.first_section = {0};
    for (std::uint32_t w = 0; w < hair.wisps; ++w) {
        const Recipe recipe = random_recipe(random, hair);
        groom.roots.push_back(random_root(random, recipe));
        groom.strands.push_back(random.count(100, 2000));
        groom.thickness_power.push_back(static_cast<float>(random.between(0, 4)));
        for (std::size_t i = 0; i < recipe.x.size(); ++i) {
            groom.position.emplace_back(recipe.x[i]);
            add_skeleton(random, recipe, i, groom);
            add_envelope(random, recipe, i, groom);
        }
        groom.first_section.push_back(static_cast<std::uint32_t>(groom.position.size()));
    }
    return groom;
}

Frame random_state(const RandomHair& hair, const Groom& groom, std::uint64_t state_seed) {
    RandomNumbers random(hair.seed ^ (state_seed << 32));
    Frame frame;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        add_state(random, hair, groom, w, frame);
    return frame;
}

} // namespace mane::reference
