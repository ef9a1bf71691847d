#include "interactions/character_contact.h"
#include "interactions/character_planes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mane {
namespace {

constexpr RegionTest::Approach kAll{.section = 0xffff, .segment = 0xffff, .spent = 0};
/// A support point this near to an envelope point is that point.
constexpr float kAtEnvelopePoint = 0.98f;

/// Kept from wisp to wisp.
struct DetectionScratch {
    WispCopy wisp;
    PlaneFinder planes;
    std::vector<SurfacePlace> around;
    std::vector<RegionTest::Approach> flags; // bodies × rows of the packet
};

bool nearer_the_root(const SlidingContact& a, const SlidingContact& b) {
    return a.point.section < b.point.section;
}

/// Detection for one wisp and one body, from root to tip.
class Detector {
  public:
    Detector(const WispCopy& wisp, const ContactBody& body, std::uint32_t number,
             const CharacterContactDesc& desc, DetectionScratch& scratch,
             std::vector<SlidingContact>& contacts)
        : wisp_(wisp), surface_(*body.surface), worn_(body.worn), number_(number), desc_(desc),
          contacts_(contacts), planes_(scratch.planes), around_(scratch.around) {}

    /// `could_touch(i)`: what may touch of section i and of the segment that ends there; the rest
    /// is passed over.
    template <typename CouldTouch, typename Region>
    void run(std::span<CarriedPoint> carried, CouldTouch&& could_touch, Region&& region) {
        carried_ = carried;
        before_ = here_ = {};
        bool under = worn_ && inside(1);
        for (std::uint32_t i = 2; i < wisp_.sections(); ++i) {
            under = under && inside(i);
            if (under) {
                carried[i].settled = true;
                continue;
            }
            const auto [section, segment] = could_touch(i);
            if (section || segment)
                region_ = region(i);
            if (surface_.duration() > 0 && segment) {
                look_around(i - 1);
                look_around(i);
                touch_segment(i - 1, of(i - 1), of(i));
            }
            if (surface_.duration() > 0 && section) {
                look_around(i);
                touch_section(i, of(i));
            }
        }
    }

  private:
    /// What is known of the surface around a section: nothing of it is nearer than `clear`.
    struct Reach {
        std::uint32_t section = 0; // 0: none yet
        Vec3d from;
        std::optional<SurfacePlace> place;
        Vec3d way;      // unit, toward the surface
        Vec3d velocity; // of the place
        double clear = 0;
    };

    bool inside(std::uint32_t i) const { return surface_.start().inside(Vec3d(wisp_.x[i])); }

    // One search per section, as wide as any of its points could get to within the block. All else
    // follows from its answer, since the distance to a surface changes by no more than the way
    // between two points.
    const Reach& look_around(std::uint32_t i) {
        if (here_.section == i || before_.section == i)
            return of(i);
        before_ = here_;
        here_ = looked_around(i);
        return here_;
    }
    const Reach& of(std::uint32_t i) const { return here_.section == i ? here_ : before_; }

    Reach looked_around(std::uint32_t i) {
        CarriedPoint& carried = carried_[i];
        const double block = surface_.duration();
        double rate = 0;
        for (std::uint32_t line = 0; line < wisp_.k(); ++line)
            rate = std::max(rate, std::abs(double(wisp_.rate(i, line))));
        const double speed =
            length(Vec3d(wisp_.v[i])) + rate + surface_.fastest() + kAcceleration * block;
        Reach reach;
        reach.section = i;
        reach.from = Vec3d(wisp_.x[i]);
        reach.clear = double(desc_.threshold) + double(wisp_.largest_radius(i)) + speed * block;
        const bool out_of_reach = region_.clear(reach.from) > reach.clear;
        if (!out_of_reach && look_near(carried.triangle, reach)) {
            carried.triangle = reach.place->triangle;
            reach.way = way_to_surface(reach);
            if (block > 0)
                reach.velocity = velocity_at(surface_, *reach.place);
        }
        carried.clear = reach.clear;
        carried.found = reach.place.has_value();
        return reach;
    }

    // Finds the nearest place, if it is no farther than `clear` tells, and leaves in around_ all
    // that are nearly as near. The triangle that was nearest a block ago tells how far to look;
    // where it is no longer near, hardly anything is (one section in a hundred).
    bool look_near(std::uint32_t before, Reach& reach) {
        double distance = reach.clear;
        if (before != PosedSurface::kNoGuess)
            distance = std::min(
                distance, std::sqrt(surface_.start().place_on(before, reach.from).closest.squared));
        surface_.start().within(reach.from, distance + kAsNear, around_);
        const auto nearest = std::min_element(around_.begin(), around_.end(), nearer);
        if (nearest == around_.end() || nearest->closest.squared > reach.clear * reach.clear)
            return false;
        reach.place = *nearest;
        reach.clear = std::sqrt(nearest->closest.squared);
        return true;
    }

    // To all places that are nearly as near as the nearest, each with a weight that falls to 0
    // where it is farther by kAsNear. In a hollow the one nearest place jumps from side to side,
    // and the wisp's support with it; a wisp at rest would shake.
    Vec3d way_to_surface(const Reach& reach) const {
        Vec3d sum;
        for (const SurfacePlace& place : around_) {
            const double distance = std::sqrt(place.closest.squared),
                         farther = distance - reach.clear;
            if (distance > 0 && farther < kAsNear)
                sum += (place.closest.point - reach.from) * ((1 - farther / kAsNear) / distance);
        }
        return length(sum) > 0 ? normalized(sum) : sum;
    }
    static constexpr double kAsNear = 1e-3; // [m]

    void touch_section(std::uint32_t i, const Reach& reach) {
        if (!reach.place)
            return;
        touch({i, 0, 0, 0, 0}, reach.clear, reach.velocity);
        for (std::uint32_t line = 0; line < wisp_.k(); ++line)
            touch({i, 0, line, 1, 0}, reach.clear - double(wisp_.r(i, line)), reach.velocity);
        touch_support(support_point(wisp_, i, 0, Vec3(reach.way)),
                      reach.clear - double(wisp_.largest_radius(i)), reach);
    }

    // The middle of a segment and the envelope there. Nothing is nearer to the middle than half a
    // segment less than to the clearer of its ends.
    void touch_segment(std::uint32_t i, const Reach& a, const Reach& b) {
        const double half = length(Vec3d(wisp_.x[i + 1]) - Vec3d(wisp_.x[i])) / 2;
        const Reach& near = !b.place || (a.place && a.clear < b.clear) ? a : b;
        if (!near.place)
            return;
        const double clear = std::max(a.clear, b.clear) - half;
        touch({i, 0.5f, 0, 0, 0}, clear, near.velocity);
        // The arc reaches out toward both ends' ways: toward the nearer one's alone it would jump
        // where they are equally near.
        const WispPoint support = support_point(wisp_, i, 0.5f, Vec3(a.way + b.way));
        const float radius = std::max(wisp_.largest_radius(i), wisp_.largest_radius(i + 1));
        touch_support(support, clear - double(radius), near);
    }

    void touch_support(const WispPoint& point, double clear, const Reach& reach) {
        const bool between = point.alpha > 0 && point.beta > 0;
        const bool apart = point.along > 0 || std::max(point.alpha, point.beta) < kAtEnvelopePoint;
        if (between && apart)
            touch(point, clear, reach.velocity);
    }

    /// Looks for the planes of one point, nothing being nearer to it than `clear`.
    void touch(const WispPoint& point, double clear, const Vec3d& surface_velocity) {
        Approach approach;
        approach.velocity = Vec3d(wisp_.velocity(point));
        approach.speed = length(approach.velocity - surface_velocity);
        approach.threshold = double(desc_.threshold);
        approach.push_out = double(desc_.push_out);
        if (clear > approach.reach(surface_.duration()))
            return;
        approach.position = Vec3d(wisp_.position(point));
        if (region_.clear(approach.position) > approach.reach(surface_.duration()))
            return;
        for (const NearPlane& plane : planes_.find(surface_, approach))
            add(point, plane);
    }

    void add(const WispPoint& point, const NearPlane& plane) {
        const std::uint32_t t = plane.place.triangle;
        const Vec3d end_normal = surface_.carried_direction(t, plane.normal);
        SlidingContact contact;
        contact.point = point;
        contact.body = number_;
        contact.triangle = t;
        contact.anchor = Vec3(plane.place.closest.point);
        contact.anchor_change = Vec3(velocity_at(surface_, plane.place) * surface_.duration());
        contact.normal = Vec3(plane.normal);
        contact.normal_change = Vec3(end_normal - plane.normal);
        contact.threshold = static_cast<float>(plane.threshold);
        contacts_.push_back(contact);
    }

    std::span<CarriedPoint> carried_;
    CharacterRegions::Here region_; // of the section
    Reach before_, here_;           // the last two that were looked around
    const WispCopy& wisp_;
    const Surface& surface_;
    bool worn_;
    std::uint32_t number_;
    const CharacterContactDesc& desc_;
    std::vector<SlidingContact>& contacts_;
    PlaneFinder& planes_;
    std::vector<SurfacePlace>& around_;
};

/// Nothing has been looked for at this block's start yet.
void start_carried(const HairView& hair, const Packet& packet, std::uint32_t lane,
                   std::size_t bodies, std::vector<CarriedPoint>& carried) {
    const std::uint32_t sections = packet.sections[lane];
    carried.resize(bodies * sections);
    for (std::uint32_t n = 0; n < carried.size(); ++n) {
        const std::uint32_t i = n % sections;
        carried[n].start = hair.state.position.vec({packet.first_row + i, lane});
        carried[n].clear = 0;
        carried[n].found = false;
        carried[n].settled = i < 2;
        carried[n].near = false;
    }
}

/// One wisp of a packet: all that is written.
struct WispDetection {
    std::uint32_t wisp, lane;
    std::vector<SlidingContact>& contacts;
    std::vector<CarriedPoint>& carried; // bodies × sections
};

/// Looks for the contacts of a wisp, and for the regions that are used up.
void look_for_contacts(const HairView& hair, std::span<const ContactBody> bodies,
                       const CharacterContactDesc& desc, const Packet& packet,
                       const WispDetection& task, std::span<CharacterRegions> regions,
                       DetectionScratch& scratch) {
    WispCopy& wisp = scratch.wisp;
    wisp.load(hair, task.wisp);
    const std::uint32_t sections = wisp.sections();
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
        const auto carried = std::span(task.carried).subspan(b * sections, sections);
        const RegionTest::Approach* flags = scratch.flags.data() + b * packet.rows;
        const auto has = [&](std::uint16_t bits) { return (bits >> task.lane & 1) != 0; };
        Detector(wisp, bodies[b], b, desc, scratch, task.contacts)
            .run(
                carried,
                [&](std::uint32_t i) {
                    return std::pair(has(flags[i].section), has(flags[i].segment));
                },
                [&](std::uint32_t i) {
                    return regions[b].here({packet.first_row + i, task.lane});
                });
        for (std::uint32_t i = 1; i < sections; ++i) {
            if (!has(flags[i].spent))
                continue;
            double segment = length(Vec3d(wisp.x[i]) - Vec3d(wisp.x[i - 1]));
            if (i + 1 < sections)
                segment = std::max(segment, length(Vec3d(wisp.x[i + 1]) - Vec3d(wisp.x[i])));
            regions[b].renew({packet.first_row + i, task.lane}, wisp.x[i],
                             double(wisp.largest_radius(i)) + segment / 2, carried[i].triangle,
                             carried[i].found);
        }
    }
    // those of one body come sorted
    if (!std::is_sorted(task.contacts.begin(), task.contacts.end(), nearer_the_root))
        std::stable_sort(task.contacts.begin(), task.contacts.end(), nearer_the_root);
}

} // namespace

void CharacterContacts::begin(const HairView& hair, std::span<const ContactBody> bodies) {
    contacts_.resize(hair.groom.wisp_count());
    carried_.resize(hair.groom.wisp_count());
    regions_.resize(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b)
        regions_[b].begin(hair, *bodies[b].surface);
    duration_ = bodies.empty() ? 0 : bodies[0].surface->duration();
}

void CharacterContacts::detect(const HairView& hair, std::span<const ContactBody> bodies,
                               const CharacterContactDesc& desc, Threads& threads) {
    begin(hair, bodies);
    const double reach = double(desc.threshold) + kAcceleration * duration_ * duration_;
    threads.run(hair.layout.packets().size(), [&](std::size_t p) {
        const Packet& packet = hair.layout.packets()[p];
        DetectionScratch scratch;
        scratch.flags.assign(bodies.size() * packet.rows, kAll);
        for (std::uint32_t b = 0; b < bodies.size() && ablation_.clear_regions; ++b)
            regions_[b].approach(region_test_, hair, p, reach, ablation_.clear_reach,
                                 scratch.flags.data() + b * packet.rows);
        std::uint32_t asked = 0;
        for (const RegionTest::Approach& row : scratch.flags)
            asked |= row.section | row.segment | row.spent;
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const std::uint32_t w = packet.wisp[lane];
            if (w == Layout::kNoWisp)
                continue;
            contacts_[w].clear();
            start_carried(hair, packet, lane, bodies.size(), carried_[w]);
            if ((asked >> lane & 1) != 0)
                look_for_contacts(hair, bodies, desc, packet, {w, lane, contacts_[w], carried_[w]},
                                  regions_, scratch);
        }
    });
}

void CharacterContacts::forget() {
    regions_.clear();
    contacts_.clear();
    carried_.clear();
    impulses_.clear();
    reactions_.clear();
}

void CharacterContacts::list(const Groom& groom, std::vector<Contact>& contacts) const {
    for (std::size_t w = 0; w < contacts_.size(); ++w)
        for (std::size_t i = 0; i < contacts_[w].size(); ++i) {
            const SlidingContact& c = contacts_[w][i];
            const bool own = c.point.along == 0 && (c.point.on_axis() || c.point.beta == 0);
            const std::uint32_t point = c.point.on_axis() ? 0 : 1 + c.point.k;
            contacts.push_back({.kind = ContactKind::sliding,
                                .point = own ? static_cast<std::uint8_t>(point) : Contact::kBetween,
                                .section = groom.first_section[w] + c.point.section,
                                .along = c.point.along,
                                .other = c.triangle,
                                .body = c.body,
                                .impulse = impulses_[w][i]});
        }
}

std::uint64_t CharacterContacts::count() const {
    std::uint64_t sum = 0;
    for (const auto& wisp : contacts_)
        sum += wisp.size();
    return sum;
}

} // namespace mane
