/// §4.1: what wisps in contact do to each other's velocities.

#include "reference/interactions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace mane::reference {
namespace {

/// One section's part in a contact.
struct Part {
    Site site;
    double weight;     ///< in the relative velocity
    double compliance; ///< what multiplies its inverse mass in W
    int k;             ///< its envelope point, or Contact::kSkeleton
};

/// The two ends of a segment at s. Where the head holds the first end, the other's weight counts
/// once, not squared: a contact next to the root must not fling it at 1/s.
void add_ends(std::vector<Part>& parts, const Site& first, double s, double sign) {
    parts.push_back({first, sign * (1 - s), (1 - s) * (1 - s), Contact::kSkeleton});
    parts.push_back({{first.wisp, first.section + 1},
                     sign * s,
                     first.section < 2 ? s : s * s,
                     Contact::kSkeleton});
}

std::vector<Part> parts_of(const Contact& c) {
    std::vector<Part> parts;
    add_ends(parts, c.segment, c.s, -1);
    if (c.k == Contact::kAxis)
        add_ends(parts, c.point, c.along, 1);
    else
        parts.push_back({c.point, 1, 1, c.k});
    return parts;
}

/// The weights of the contacts that use each skeleton point, and each envelope point: by them they
/// share its mass (M27a).
struct Users {
    std::map<Site, double> skeleton;
    std::map<std::pair<Site, int>, double> envelope;

    explicit Users(const std::vector<Contact>& contacts) {
        for (const Contact& contact : contacts)
            for (const Part& part : parts_of(contact)) {
                skeleton[part.site] += contact.weight;
                if (part.k >= 0)
                    envelope[{part.site, part.k}] += contact.weight;
            }
    }
    /// What multiplies the inverse mass of a point for a contact of a weight, given the sum of all.
    static double share(double sum, double weight) { return std::max(sum, 1.0) / weight; }
};

/// One answer to all contacts that act now.
class Answer {
  public:
    Answer(Hair& hair, const std::vector<Contact>& contacts, const WispContactDesc& desc,
           double friction_time)
        : hair_(hair), contacts_(contacts), desc_(desc), friction_time_(friction_time),
          frames_(all_frames(hair)), users_(contacts) {}

    void apply() {
        std::vector<Vec3d> impulses; // all from the velocities before
        for (const Contact& contact : contacts_)
            impulses.push_back(impulse(contact));
        for (std::size_t i = 0; i < contacts_.size(); ++i)
            for (const Part& part : parts_of(contacts_[i]))
                push(part, impulses[i]);
    }

  private:
    const SectionFrame& frame(const Site& site) const { return frames_[site.wisp][site.section]; }
    Vec3d ray(const Part& part) const {
        return half_line(frame(part.site), static_cast<std::size_t>(part.k),
                         hair_.wisps[part.site.wisp].points());
    }
    Matrix3 inverse_inertia(const Site& site) const {
        return section_inertia(hair_.wisps[site.wisp], frame(site), site.section).inverse();
    }
    static bool simulated(const Site& site) { return site.section >= 2; }

    /// What a unit impulse through the contact does to the velocity there, with the share of the
    /// masses that it may use.
    Matrix3 inverse_mass(const Part& part, double weight) const {
        if (!simulated(part.site))
            return {};
        const Matrix3 skeleton =
            Users::share(users_.skeleton.at(part.site), weight) * inverse_inertia(part.site);
        if (part.k < 0)
            return part.compliance * skeleton;
        const Vec3d d = ray(part);
        const Matrix3 across = Matrix3::scale(1) - Matrix3::outer(d, d);
        const double alone = Users::share(users_.envelope.at({part.site, part.k}), weight) /
                             hair_.wisps[part.site.wisp].envelope_mass[part.site.section];
        return product(product(across, skeleton), across) + alone * Matrix3::outer(d, d);
    }
    static Matrix3 product(const Matrix3& a, const Matrix3& symmetric) {
        return {{symmetric * a.row[0], symmetric * a.row[1], symmetric * a.row[2]}};
    }

    /// (W + Z) J = −v.
    Vec3d impulse(const Contact& contact) const {
        Matrix3 W{};
        for (const Part& part : parts_of(contact))
            W += inverse_mass(part, contact.weight);
        if (W.trace() == 0)
            return {}; // nothing that could move
        const Side p = point_side(hair_, frames_, contact), s = segment_side(hair_, contact);
        const Vec3d v = p.velocity - s.velocity;
        if (!contact.friction)
            return W.inverse() * -v; // M26: nothing is left of the relative velocity

        // M24, M25: a viscous damper, weak in the wisps' plane and rigid across it as far as there
        // is a plane.
        // No drag at all would be an infinite viscosity.
        const double f = std::max(1e-6, -std::expm1(-static_cast<double>(desc_.friction) *
                                                    contact.density * friction_time_));
        const Vec3d across = cross(p.direction, s.direction), n = normalized(across);
        const double f_n = f + (1 - f) * plane_weight(length(across));
        const double mean = W.trace() / 3, sliding = sliding_weight(length(across));
        const Matrix3 out = Matrix3::outer(n, n), in = Matrix3::scale(1) - out;
        return (W + mean * (sliding * (1 - f) / f * in + (1 - f_n) / f_n * out)).inverse() * -v;
    }

    /// Ours: from 1 at two thirds of the parallel angle to 0 at all of it, where the pair becomes a
    /// collision.
    double sliding_weight(double sine) const {
        const double angle = static_cast<double>(desc_.parallel_angle) * std::numbers::pi / 180;
        const double full = std::sin(angle * 2 / 3), none = std::sin(angle);
        const double t = std::clamp((none - sine) / (none - full), 0.0, 1.0);
        return t * t;
    }

    /// From 0 where the directions align to 1 at the fade angle.
    double plane_weight(double sine) const {
        const double full =
            std::sin(static_cast<double>(desc_.fade_angle) * std::numbers::pi / 180);
        const double t = std::clamp((sine - full / 2) / (full / 2), 0.0, 1.0);
        return t * t * (3 - 2 * t);
    }

    /// M27: an envelope point takes the impulse along its half line, its skeleton point the rest.
    /// The other envelope points are not pulled along: they keep ṙ + ẋ·d.
    void push(const Part& part, const Vec3d& J) {
        if (!simulated(part.site))
            return;
        Wisp& wisp = hair_.wisps[part.site.wisp];
        const std::size_t i = part.site.section;
        Vec3d on_skeleton = part.weight * J;
        if (part.k >= 0) {
            const Vec3d d = ray(part);
            on_skeleton -= dot(J, d) * d;
            wisp.r_rate[i][static_cast<std::size_t>(part.k)] += dot(J, d) / wisp.envelope_mass[i];
        }
        const Vec3d change = inverse_inertia(part.site) * on_skeleton;
        wisp.v[i] += change;
        for (std::size_t k = 0; k < wisp.points(); ++k)
            wisp.r_rate[i][k] -= dot(change, half_line(frame(part.site), k, wisp.points()));
    }

    Hair& hair_;
    const std::vector<Contact>& contacts_;
    const WispContactDesc& desc_;
    double friction_time_;
    Frames frames_;
    Users users_;
};

/// The rule as printed: Δv_p = −½ ((v_p − v_s)·(σ_p×σ_s)) (σ_p×σ_s), with the product bare, and a
/// drag in the plane; for a collision, half of the relative velocity.
Vec3d printed_change(const Side& p, const Side& s, const Contact& contact,
                     const WispContactDesc& desc, double friction_time) {
    const Vec3d v = p.velocity - s.velocity;
    if (!contact.friction)
        return -0.5 * v;
    const Vec3d across = cross(p.direction, s.direction), n = normalized(across);
    const double drag = static_cast<double>(desc.friction) * contact.density * friction_time;
    return -0.5 * dot(v, across) * across - drag * (v - dot(v, n) * n);
}

/// Every contact changes its point alone, and all changes are added: the segment's own points find
/// their contacts themselves.
void respond_as_printed(Hair& hair, const std::vector<Contact>& contacts,
                        const WispContactDesc& desc, double friction_time) {
    const Frames frames = all_frames(hair);
    std::vector<Vec3d> changes;
    for (const Contact& contact : contacts)
        changes.push_back(printed_change(point_side(hair, frames, contact),
                                         segment_side(hair, contact), contact, desc,
                                         friction_time));
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto [w, i] = contacts[c].point;
        if (contacts[c].k == Contact::kAxis || i < 2)
            continue;
        Wisp& wisp = hair.wisps[w];
        if (contacts[c].k == Contact::kSkeleton) {
            wisp.v[i] += changes[c];
        } else {
            const std::size_t k = static_cast<std::size_t>(contacts[c].k);
            wisp.r_rate[i][k] += dot(changes[c], half_line(frames[w][i], k, wisp.points()));
        }
    }
}

} // namespace

void respond(Hair& hair, const std::vector<Contact>& contacts, const WispContactDesc& desc,
             double friction_time) {
    std::vector<Contact> acting;
    for (const Contact& contact : contacts)
        if (!contact.friction || friction_time > 0)
            acting.push_back(contact);
    if (desc.literal)
        respond_as_printed(hair, acting, desc, friction_time);
    else
        Answer(hair, acting, desc, friction_time).apply();
}

} // namespace mane::reference
