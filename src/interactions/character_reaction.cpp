#include "interactions/character_bearings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mane {
namespace {

constexpr int kRounds = 4;      // a way out of one body may lead into another, or into another part
constexpr float kClear = 1e-5f; // [m] by which envelope points and axes stay over the surface
constexpr float kLongestLever =
    4; // an axis is lifted by moving an end at most this many times as far

/// The penetration reaction of one wisp: its skeleton from root to tip, then its envelope from root
/// to tip.
class Reactor {
  public:
    Reactor(WispCopy& wisp, std::span<const ContactBody> bodies, double push_out)
        : wisp_(wisp), bodies_(bodies), escape_(bodies, push_out),
          bearings_(wisp, bodies, escape_) {}

    /// Another wisp was loaded. `carried`: as CharacterBearings takes them.
    void begin(std::span<CarriedPoint> carried) {
        bearings_.begin(carried);
        exempt_.assign(wisp_.sections() * bodies_.size(), 0);
        moved_.assign(wisp_.sections(), false);
        reactions_.clear();
    }
    CharacterBearings& bearings() { return bearings_; }

    void run() {
        find_exempt();
        for (std::uint32_t i = 2; i < wisp_.sections(); ++i) {
            if (wisp_.answers(i))
                move_skeleton_point(i);
            for (std::uint32_t b = 0; b < bodies_.size(); ++b)
                lift_axis(i, b);
        }
        for (std::uint32_t i = 2; i < wisp_.sections(); ++i) {
            for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
                shrink_section(i, b);
                shrink_between(i, b);
            }
        }
    }

    bool moved(std::uint32_t section) const { return moved_[section]; }
    /// What was moved, with sections counted from x₀.
    std::span<const Reaction> reactions() const { return reactions_; }

  private:
    /// Worn bodies leave the sections from the root to the first point outside alone.
    void find_exempt() {
        for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
            if (!bodies_[b].worn)
                continue;
            for (std::uint32_t i = 1; i < wisp_.sections() && bearings_.inside(i, b); ++i)
                exempt_[i * bodies_.size() + b] = 1;
        }
    }
    bool exempt(std::uint32_t i, std::uint32_t b) const {
        return exempt_[i * bodies_.size() + b] != 0;
    }
    /// Per body, whether it leaves section i alone.
    std::span<const std::uint8_t> exempt(std::uint32_t i) const {
        return std::span(exempt_).subspan(i * bodies_.size(), bodies_.size());
    }

    void put(std::uint32_t i, std::uint32_t b, const Vec3& position) {
        remember(i, 0, b, position, position - wisp_.x[i]);
        wisp_.x[i] = position;
        bearings_.forget(i);
        moved_[i] = true;
    }

    /// Reactions are few, so one more question for each costs nothing.
    void remember(std::uint32_t i, std::uint32_t point, std::uint32_t b, const Vec3& position,
                  const Vec3& shift) {
        const std::optional<SurfacePlace> place = bodies_[b].surface->end().nearest(
            Vec3d(position), std::numeric_limits<double>::infinity());
        reactions_.push_back({.section = i,
                              .point = static_cast<std::uint8_t>(point),
                              .body = b,
                              .triangle = place ? place->triangle : 0,
                              .shift = shift});
    }

    void move_skeleton_point(std::uint32_t i) {
        std::uint32_t last = 0; // the body that moved it last
        for (int round = 0; round < kRounds; ++round) {
            bool in = false;
            for (std::uint32_t b = 0; b < bodies_.size(); ++b)
                if (!exempt(i, b) && move_out(i, b, round == 0)) {
                    in = true;
                    last = b;
                }
            if (!in)
                return;
        }
        if (escape_.inside(wisp_.x[i], exempt(i)))
            retreat(i, last);
    }

    /// Puts a skeleton point that is inside body `b`, or went through a part of it, before the
    /// surface. False when neither is so.
    bool move_out(std::uint32_t i, std::uint32_t b, bool with_path) {
        const Vec3 p = wisp_.x[i];
        const bool inside = bearings_.inside(i, b);
        // Its way over the block, as the body sees it: from where the nearest polygon would have
        // carried it to where it is.
        const bool may_have_path = with_path && !bearings_.segment_free(i, b);
        const CarriedPoint carried = may_have_path ? bearings_.carried(i, b) : CarriedPoint{};
        std::optional<Escape::Entry> entry;
        if (carried.near)
            entry = escape_.entry(b, carried.position, p);
        if (!inside && !entry)
            return false;
        const bool has_path = carried.near && !escape_.inside(carried.position, b);
        if (!has_path)
            entry.reset();
        if (!inside && !entry)
            return false;

        std::array<Vec3, 3> ways{};
        std::size_t count = 0;
        if (inside) {
            const std::optional<SurfacePlace> exit = escape_.exit(b, p);
            if (exit) {
                const Vec3 out = escape_.over(b, *exit, p);
                // The nearest way out of a thin part can be its far side: then it counts only as
                // reached without crossing.
                if (!has_path || escape_.free(b, carried.position, out))
                    ways[count++] = out;
            }
        }
        if (entry)
            ways[count++] = escape_.over(b, entry->place, Vec3(entry->place.closest.point));
        if (inside) {
            const std::optional<Escape::Entry> axis = escape_.entry(b, wisp_.x[i - 1], p);
            if (axis)
                ways[count++] = escape_.over(b, axis->place, Vec3(axis->place.closest.point));
        }
        put_best(i, b, std::span(ways).first(count));
        return true;
    }

    /// Takes the first way that is outside and whose axis to the section before is free; else the
    /// first that is outside; else goes back along the axis.
    void put_best(std::uint32_t i, std::uint32_t b, std::span<const Vec3> ways) {
        const Vec3* best = nullptr;
        for (const Vec3& way : ways) {
            if (escape_.inside(way, exempt(i)))
                continue;
            if (!best)
                best = &way;
            if (!escape_.free(b, wisp_.x[i - 1], way))
                continue;
            best = &way;
            break;
        }
        if (best)
            put(i, b, *best);
        else
            retreat(i, b);
    }

    /// Back along the axis until outside every body: the section before is outside, so near enough
    /// to it all is. `because`: the body that it is for.
    void retreat(std::uint32_t i, std::uint32_t because) {
        const Vec3 from = wisp_.x[i - 1], way = wisp_.x[i] - from;
        double at = 1;
        for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
            if (exempt(i, b))
                continue;
            const std::optional<Escape::Entry> entry = escape_.entry(b, from, wisp_.x[i]);
            if (entry)
                at = std::min(at, entry->at);
        }
        Vec3 back = wisp_.x[i];
        for (int halving = 0; halving < 24 && escape_.inside(back, exempt(i)); ++halving) {
            at /= 2;
            back = from + way * static_cast<float>(at);
        }
        put(i, because, back);
    }

    /// Where the axis goes through a convex part with both ends outside, its deepest point is
    /// lifted to the surface by moving its ends, each by its weight there (the least movement that
    /// does it).
    void lift_axis(std::uint32_t i, std::uint32_t b) {
        if (exempt(i, b) || exempt(i - 1, b) || bearings_.axis_free(i, b))
            return;
        for (int round = 0; round < kRounds; ++round) {
            const std::optional<float> middle =
                escape_.middle_of_stretch(b, wisp_.x[i - 1], wisp_.x[i]);
            if (!middle)
                return;
            const float s = *middle;
            const Vec3 deep = wisp_.x[i - 1] * (1 - s) + wisp_.x[i] * s;
            const std::optional<SurfacePlace> exit = escape_.exit(b, deep);
            if (!exit)
                return;
            const Vec3 lift = escape_.over(b, *exit, deep, double(kClear) * 10) - deep;
            if (!lift_ends(i, b, lift, s))
                return;
        }
    }

    bool lift_ends(std::uint32_t i, std::uint32_t b, const Vec3& lift, float s) {
        if (!wisp_.answers(i))
            return wisp_.answers(i - 1) && lift_alone(i - 1, b, lift, 1 - s);
        const float first = wisp_.answers(i - 1) ? 1 - s : 0.0f;
        const float sum = first * first + s * s;
        const Vec3 before = wisp_.x[i - 1] + lift * (first / sum),
                   here = wisp_.x[i] + lift * (s / sum);
        const bool both = first > 0 && may_stand(i - 1, before) && may_stand(i, here);
        if (both) {
            put(i - 1, b, before);
            put(i, b, here);
            return true;
        }
        return lift_alone(i, b, lift, s);
    }

    bool lift_alone(std::uint32_t i, std::uint32_t b, const Vec3& lift, float share) {
        const Vec3 alone = wisp_.x[i] + lift * std::min(1 / share, kLongestLever);
        if (!may_stand(i, alone))
            return false;
        put(i, b, alone);
        return true;
    }

    bool may_stand(std::uint32_t i, const Vec3& position) {
        if (escape_.inside(position, exempt(i)))
            return false;
        for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
            // no way through a part of a body, for the point or for the axis behind it
            if (exempt(i, b))
                continue;
            if (!escape_.free(b, wisp_.x[i], position))
                return false;
        }
        return true;
    }

    /// The envelope points of a section, then the drawn surface halfway between them, come back to
    /// the surface: each along the line from the skeleton point, which is outside.
    void shrink_section(std::uint32_t i, std::uint32_t b) {
        if (exempt(i, b) || bearings_.segment_free(i, b))
            return;
        const Vec3 centre = wisp_.x[i];
        const CharacterBearings::Roof roof = bearings_.section_roof(i, b);
        for (std::uint32_t line = 0; line < wisp_.k(); ++line) {
            const WispPoint point{i, 0, line, 1, 0};
            const float share = share_outside(b, centre, wisp_.position(point), roof);
            if (share < 1)
                scale(i, b, line, share);
        }
        for (std::uint32_t line = 0; line < wisp_.k(); ++line) {
            const Vec3 end = wisp_.position(wisp_.half_arc(i, line));
            const float share = share_outside(b, centre, end, roof);
            if (share < 1)
                scale_sector(i, b, line, share);
        }
    }

    /// The drawn surface halfway along the segment that ends at section i, where the strands'
    /// curves (Catmull-Rom) run outside the chords. Not on the first segment: its first section
    /// rides the skin with radii of its own, and the second one cannot make up for them.
    void shrink_between(std::uint32_t i, std::uint32_t b) {
        if (!WispCopy::simulated(i - 1) || exempt(i - 1, b) || bearings_.segment_free(i, b))
            return;
        const Vec3 centre = wisp_.halfway(i, {});
        CharacterBearings::Roof roof = bearings_.halfway_roof(i, b);
        bool outside = false; // the centre, once it matters
        for (std::uint32_t line = 0; line < wisp_.k(); ++line) {
            for (const WispPoint& point : {WispPoint{i, 0, line, 1, 0}, wisp_.half_arc(i, line)}) {
                const Vec3 end = wisp_.halfway(i, point);
                if (roof.under(centre, end))
                    continue;
                if (!outside && escape_.inside(centre, b))
                    return;
                outside = true;
                const float share = share_outside(b, centre, end, roof);
                if (share >= 1)
                    continue;
                for (std::uint32_t section : {i - 1, i}) {
                    scale(section, b, line, share);
                    if (point.beta > 0)
                        scale(section, b, wisp_.next(line), share);
                }
                roof =
                    bearings_.halfway_roof(i, b); // a curve's tangents stay: not all moves inward
            }
        }
    }

    /// The share of the way from `centre` (outside) to `end` that is outside; 1 when `end` is
    /// outside (M31).
    float share_outside(std::uint32_t b, const Vec3& centre, const Vec3& end,
                        const CharacterBearings::Roof& roof) {
        if (roof.under(centre, end))
            return 1;
        const std::optional<Escape::Entry> entry = escape_.entry_to_stay(b, centre, end);
        if (!entry)
            return 1;
        return std::max(0.0f, static_cast<float>(entry->at) - kClear / length(end - centre));
    }

    void scale(std::uint32_t i, std::uint32_t b, std::uint32_t line, float share) {
        const Vec3 lost = wisp_.d(i, line) * (wisp_.r(i, line) * (share - 1));
        wisp_.r(i, line) *= share;
        remember(i, 1 + line, b, wisp_.position({i, 0, line, 1, 0}), lost);
        bearings_.forget_envelope(i);
        moved_[i] = true;
    }
    void scale_sector(std::uint32_t i, std::uint32_t b, std::uint32_t line, float share) {
        scale(i, b, line, share);
        scale(i, b, wisp_.next(line), share);
    }

    WispCopy& wisp_;
    std::span<const ContactBody> bodies_;
    Escape escape_;
    CharacterBearings bearings_;
    std::vector<std::uint8_t> exempt_; // sections × bodies
    std::vector<bool> moved_;
    std::vector<Reaction> reactions_;
};

/// What the regions tell of a packet's sections at the block's end: a bit per lane, bodies × rows.
class FreeSections {
  public:
    FreeSections(std::size_t bodies, const Packet& packet)
        : packet_(packet), bits_(bodies * packet.rows, 0) {}

    std::uint16_t* of_body(std::size_t b) { return bits_.data() + b * packet_.rows; }

    /// Whether the section that ends a segment and all that hangs on the segment are free.
    bool segment(std::size_t b, std::uint32_t lane, std::uint32_t i) const {
        const std::uint16_t* rows = bits_.data() + b * packet_.rows;
        return (rows[i] & rows[i - 1] & 1u << lane) != 0;
    }
    bool whole_wisp(std::size_t bodies, std::uint32_t lane) const {
        for (std::size_t b = 0; b < bodies; ++b)
            for (std::uint32_t i = 2; i < packet_.sections[lane]; ++i)
                if (!segment(b, lane, i))
                    return false;
        return true;
    }

  private:
    const Packet& packet_;
    std::vector<std::uint16_t> bits_;
};

} // namespace

std::uint64_t CharacterContacts::react(const HairView& hair, std::span<const ContactBody> bodies,
                                       const CharacterContactDesc& desc, State& state,
                                       Threads& threads) {
    const std::size_t wisps = hair.groom.wisp_count(), packets = hair.layout.packets().size();
    bool current = ablation_.clear_regions && regions_.size() == bodies.size();
    for (std::size_t b = 0; current && b < bodies.size(); ++b)
        current = regions_[b].current(*bodies[b].surface);
    carried_.resize(wisps);
    std::vector<std::vector<Reaction>> reactions(packets);
    threads.run(packets, [&](std::size_t p) {
        const Packet& packet = hair.layout.packets()[p];
        FreeSections free(bodies.size(), packet);
        for (std::size_t b = 0; current && b < bodies.size(); ++b)
            regions_[b].stay(region_test_, hair, p, free.of_body(b));
        WispCopy wisp;
        Reactor reactor(wisp, bodies, double(desc.push_out));
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const std::uint32_t w = packet.wisp[lane];
            if (w == Layout::kNoWisp || free.whole_wisp(bodies.size(), lane))
                continue;
            wisp.load(hair, w);
            // without a detection, nothing is known of the block's start
            carried_[w].resize(bodies.size() * wisp.sections());
            reactor.begin(carried_[w]);
            for (std::uint32_t b = 0; b < bodies.size(); ++b)
                for (std::uint32_t i = 2; i < wisp.sections(); ++i)
                    if (free.segment(b, lane, i))
                        reactor.bearings().set_free(i, b);
            reactor.run();
            for (Reaction reaction : reactor.reactions()) {
                reaction.section += hair.groom.first_section[w];
                reactions[p].push_back(reaction);
            }
            for (std::uint32_t i = 2; i < wisp.sections(); ++i) {
                if (reactor.moved(i))
                    wisp.store_place(hair, i, state);
            }
        }
    });
    for (std::size_t b = 0; current && b < bodies.size(); ++b)
        regions_[b].end();
    reactions_.clear();
    for (const std::vector<Reaction>& found : reactions)
        reactions_.insert(reactions_.end(), found.begin(), found.end());
    std::stable_sort(reactions_.begin(), reactions_.end(), // packets are not
                     [](const Reaction& a, const Reaction& b) { return a.section < b.section; });
    return reactions_.size();
}

} // namespace mane
