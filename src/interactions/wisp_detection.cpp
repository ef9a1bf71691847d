#include "interactions/wisp_detection.h"

#include "base/functions.h"
#include "base/room.h"
#include "interactions/axis_test.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mane {
namespace {

constexpr std::size_t kSegmentsPerChunk = 8 * kLanes;
constexpr std::size_t kBunchesPerChunk = 64;

float sine_of(double degrees) {
    return static_cast<float>(sine_of_degrees(degrees));
}
float tangent_of(double degrees) {
    return static_cast<float>(sine_of_degrees(degrees) / cosine(degrees * (kPi / 180)));
}

ParallelLimits limits_of(const WispContactDesc& desc) {
    ParallelLimits limits;
    limits.sine[0] = sine_of(desc.parallel_angle);
    limits.sine[1] = sine_of(std::min(89.f, desc.parallel_angle * desc.hysteresis));
    limits.tangent[0] = tangent_of(desc.parallel_angle);
    limits.tangent[1] = limits.tangent[0] * desc.hysteresis;
    limits.speed[0] = desc.sliding_speed;
    limits.speed[1] = desc.sliding_speed * desc.hysteresis;
    limits.sine_fade = sine_of(desc.fade_angle);
    return limits;
}

/// A contact begins with nothing at the surface and counts in full where it is deeper than this:
/// with full strength at once it takes its part of the shared masses from the others in one step,
/// and a wisp that rests at another's surface beats.
constexpr float kFullDepth = 0.8f;
float weight_at(float depth) {
    return std::clamp((1 - depth) / (1 - kFullDepth), 1e-3f, 1.f);
}

/// No segment; fills up lists of them.
constexpr std::uint32_t kNone = ~0u;

/// Whether a list that fills whole fours has a number.
bool has(std::span<const std::uint32_t> fours, std::uint32_t number) {
    using FourWhole [[gnu::vector_size(16)]] = std::uint32_t;
    FourBits equal{};
    for (std::size_t i = 0; i < fours.size(); i += 4) {
        FourWhole four;
        std::memcpy(&four, &fours[i], sizeof four);
        equal |= four == number;
    }
    const Those those(equal);
    return those.begin() != those.end();
}

std::size_t chunks_of(std::size_t things, std::size_t per_chunk) {
    return (things + per_chunk - 1) / per_chunk;
}

/// The points that slid in a segment at the last detection, gone through along with those of now.
class Earlier {
  public:
    explicit Earlier(std::span<const std::uint32_t> places) : places_(places) {}

    /// Whether a point did; asked for points by rising place.
    bool slid(std::uint32_t place) {
        while (next_ < places_.size() && places_[next_] < place)
            ++next_;
        return next_ < places_.size() && places_[next_] == place;
    }

  private:
    std::span<const std::uint32_t> places_;
    std::size_t next_ = 0;
};

} // namespace

WispDetection::WispDetection(const WispContactDesc& desc, const Ablation& ablation,
                             const std::string& instruction_set)
    : desc_(desc), ablation_(ablation), limits_(limits_of(desc)),
      point_test_(point_test_for(instruction_set)), axis_search_(axis_search_for(instruction_set)) {
}

void WispDetection::change(const WispContactDesc& desc) {
    desc_ = desc;
    limits_ = limits_of(desc);
}

void WispDetection::forget() {
    list_.clear();
    for (Found& found : chunks_)
        for (Sliding* sliding : {&found.points, &found.along})
            *sliding = {};
}

void WispDetection::detect(const HairView& hair, const ContactPoints& points, Threads& threads,
                           bool count_pairs) {
    counts_pairs_ = count_pairs;
    if (index_.empty())
        list_segments(hair, points);
    place_boxes(points, threads);
    if (std::any_of(segments_.begin(), segments_.end(),
                    [&](std::uint32_t rank) { return slender(points, rank); }))
        place_axes(points, threads);
    begin_chunks();
    threads.run(chunks_.size(), [&](std::size_t c) { find_chunk(hair, points, c); });
    if (count_pairs)
        threads.run(chunks_.size(), [&](std::size_t c) { this->count_pairs(c); });
    collect();
}

std::span<const std::uint32_t> WispDetection::Sliding::of(std::size_t segment) const {
    if (first.empty())
        return {}; // there was no call
    const std::size_t end = segment + 1 < first.size() ? first[segment + 1] : number.size();
    return std::span(number).subspan(first[segment], end - first[segment]);
}

void WispDetection::Sliding::clear() {
    number.clear();
    first.clear();
}

void WispDetection::list_segments(const HairView& hair, const ContactPoints& points) {
    for (std::uint32_t r = 0; r < points.order.size(); ++r)
        if (points.order.next(r) != ContactOrder::kNone &&
            hair.layout.simulated(points.order.section(r) + 1))
            segments_.push_back(r);
    index_.resize(points.order.size());
    for (std::uint32_t i = 0; i < segments_.size(); ++i)
        index_[segments_[i]] = i;
    first_met_.resize(segments_.size());
    list_.inside.resize(points.order.size());
}

void WispDetection::place_boxes(const ContactPoints& points, Threads& threads) {
    hulls_.resize(points.bunches());
    threads.run_ranges(hulls_.size(), kBunchesPerChunk, [&](std::size_t first, std::size_t last) {
        point_test_.hulls(points, hulls_.data(), first, last);
    });
    bunch_tree_.update(hulls_);
}

void WispDetection::place_axes(const ContactPoints& points, Threads& threads) {
    axes_.resize(points.bunches());
    for (AxisBunch& bunch : axes_)
        bunch.clear();
    for (const std::uint32_t rank : segments_)
        axes_[rank / kLanes].set(points, rank, slender(points, rank));
    threads.run_ranges(hulls_.size(), kBunchesPerChunk, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b)
            hulls_[b] = axes_[b].boxes.hull();
    });
    axes_tree_.update(hulls_);
}

/// What was found at the last call becomes earlier, for all before any is asked.
void WispDetection::begin_chunks() {
    chunks_.resize(chunks_of(segments_.size(), kSegmentsPerChunk));
    list_.found.resize(chunks_.size());
    for (Found& found : chunks_) {
        std::swap(found.points, found.earlier_points);
        std::swap(found.along, found.earlier_along);
        found.points.clear();
        found.along.clear();
        found.axes.clear();
        found.met.clear();
        found.pairs = 0;
    }
}

void WispDetection::find_chunk(const HairView& hair, const ContactPoints& points,
                               std::size_t chunk) {
    thread_local Scratch scratch;
    scratch.has_met.resize(std::max(scratch.has_met.size(), segments_.size()));
    scratch.contacts.clear();
    scratch.counts.clear();
    Found& found = chunks_[chunk];
    const std::size_t first = chunk * kSegmentsPerChunk,
                      last = std::min(segments_.size(), first + kSegmentsPerChunk);
    std::size_t next_slender = 0;
    for (std::size_t i = first; i < last; ++i) {
        const std::size_t in_group = i % kLanes;
        if (in_group == 0) {
            const std::size_t size = std::min<std::size_t>(last - i, kLanes);
            search(points, std::span(segments_).subspan(i, size), scratch);
            next_slender = 0;
        }
        const std::size_t before = scratch.contacts.size();
        take_points(points, i, scratch.inside[in_group], found, scratch);
        scratch.counts.push_back(scratch.contacts.size() - before);
        found.along.begin_segment();
        if (slender(points, segments_[i]))
            for (const std::uint32_t other : scratch.axes[next_slender++])
                take_axis(hair, points, segments_[i], other, found);
    }
    keep(scratch, chunk);
}

void WispDetection::keep(const Scratch& scratch, std::size_t chunk) {
    std::vector<PointContact>& kept = list_.found[chunk];
    make_room(kept, scratch.contacts.size());
    std::copy(scratch.contacts.begin(), scratch.contacts.end(), kept.begin());
    std::span<const PointContact> left = kept;
    std::size_t segment = chunk * kSegmentsPerChunk;
    for (const std::size_t count : scratch.counts) {
        list_.inside[segments_[segment++]] = left.first(count);
        left = left.subspan(count);
    }
}

/// Looks for the points inside a group of segments, and for the axes that cross theirs. Segments
/// that follow each other are near each other: what is near to them is looked for once.
void WispDetection::search(const ContactPoints& points, std::span<const std::uint32_t> group,
                           Scratch& scratch) const {
    Box hull = Box::nowhere();
    scratch.slender.clear();
    for (const std::uint32_t rank : group) {
        const Box box = segment_box(points, rank);
        hull.add(box.low);
        hull.add(box.high);
        if (slender(points, rank))
            scratch.slender.push_back(rank);
    }
    point_test_.gather(bunch_tree_, hull, scratch.near);
    point_test_.find(points, group, scratch.near, scratch.inside.data());
    if (scratch.slender.empty())
        return;
    point_test_.gather(axes_tree_, hull, scratch.near);
    axis_search_.find(points, axes_.data(), scratch.slender, limits_.sine_fade, scratch.near,
                      scratch.axes.data());
}

/// The points in the volume of a segment (M21).
void WispDetection::take_points(const ContactPoints& points, std::size_t index,
                                PointsInside& inside, Found& found, Scratch& scratch) {
    const std::uint32_t rank = segments_[index];
    point_test_.classify(points, rank, limits_, inside);
    first_met_[index] = static_cast<std::uint32_t>(found.met.size());
    found.points.begin_segment();
    Earlier earlier(found.earlier_points.of(index % kSegmentsPerChunk));
    for (std::size_t p = 0; p < inside.count; ++p) {
        const std::uint32_t point = inside.point[p], at = point / 16, code = point % 16;
        const Belongs belongs = belongs_to(points, at, rank);
        if (!belongs.before && !belongs.after)
            continue;
        const std::uint32_t place = points.place(at, code);
        const bool slid = earlier.slid(place);
        const bool parallel =
            desc_.mode != WispContactMode::isotropic && (inside.parallel[p] & (slid ? 2 : 1));
        scratch.contacts.emplace_back(
            point, inside.s[p], inside.density[p], weight_at(inside.depth[p]),
            parallel ? WispContactKind::friction : WispContactKind::collision);
        if (parallel)
            found.points.number.push_back(place);
        if (counts_pairs_)
            meet(points, belongs, at, found, scratch);
    }
    for (std::size_t m = first_met_[index]; m < found.met.size(); ++m)
        scratch.has_met[found.met[m]] = false;
    found.met.resize((found.met.size() + 3) / 4 * 4, kNone);
}

/// A section stands for the segment before it and the one after it: which of them may touch the
/// segment that begins at `rank`.
WispDetection::Belongs WispDetection::belongs_to(const ContactPoints& points, std::uint32_t at,
                                                 std::uint32_t rank) const {
    const bool begins = points.order.next(at) != ContactOrder::kNone, ends = !points.held[at];
    if (points.wisp[at] != points.wisp[rank])
        return {ends, begins};
    if (!ablation_.self_collision)
        return {false, false};
    // Two segments of one wisp must share no section (M22).
    const std::uint32_t section = points.order.section(at), segment = points.order.section(rank);
    return {ends && (segment + 2 < section || segment > section),
            begins && (segment + 1 < section || segment > section + 1)};
}

/// Notes the segments that a section belongs to, once each.
void WispDetection::meet(const ContactPoints& points, const Belongs& belongs, std::uint32_t at,
                         Found& found, Scratch& scratch) const {
    const auto note = [&](std::uint32_t other) {
        if (scratch.has_met[other])
            return;
        scratch.has_met[other] = true;
        found.met.push_back(other);
    };
    if (belongs.before)
        note(index_[points.order.before(at)]);
    if (belongs.after)
        note(index_[at]);
}

/// Ours, beyond the paper's footnote: axes that cross that of a slender segment.
/// A contact is told from the earlier segment, whichever was slender.
void WispDetection::take_axis(const HairView& hair, const ContactPoints& points, std::uint32_t rank,
                              std::uint32_t other, Found& found) const {
    const std::uint32_t a = points.order.section(rank), b = points.order.section(other);
    const bool same_wisp = hair.layout.wisp_of(a) == hair.layout.wisp_of(b);
    if (same_wisp && (!ablation_.self_collision || std::max(a, b) - std::min(a, b) < 2))
        return;
    const auto axis = axis_contact(points, a < b ? rank : other, a < b ? other : rank);
    if (!axis)
        return;
    WispContact contact{.section = std::min(a, b),
                        .point = {ContactPoint::kAxis},
                        .segment = std::max(a, b),
                        .s = axis->on_second,
                        .along = axis->on_first,
                        .density = axis->density,
                        .weight = weight_at(axis->depth)};
    if (slides_along(points, contact, slid_along(rank, other))) {
        contact.kind = WispContactKind::friction;
        found.along.number.push_back(other);
    }
    found.axes.push_back(contact);
}

/// Whether two axes slid at the last call, from whichever of the two they were found.
bool WispDetection::slid_along(std::uint32_t rank, std::uint32_t other) const {
    const auto had = [&](std::uint32_t of, std::uint32_t number) {
        const std::uint32_t i = index_[of];
        const auto slid = chunks_[i / kSegmentsPerChunk].earlier_along.of(i % kSegmentsPerChunk);
        return std::binary_search(slid.begin(), slid.end(), number);
    };
    return had(rank, other) || had(other, rank);
}

/// Whether two axes in contact are quasi-parallel (M23).
bool WispDetection::slides_along(const ContactPoints& points, const WispContact& contact,
                                 bool slid) const {
    if (desc_.mode == WispContactMode::isotropic)
        return false;
    const std::uint32_t first = points.order.rank(contact.section),
                        second = points.order.rank(contact.segment);
    const auto velocity = [&](std::uint32_t rank, float s) {
        const auto of = [&](std::uint32_t r) {
            return first_three(points.velocity[points.place(r)]);
        };
        return of(rank) * (1 - s) + of(points.order.next(rank)) * s;
    };
    const Vec3 n =
        cross(first_three(points.direction[first]), first_three(points.direction[second]));
    const float sine = length(n);
    if (sine >= limits_.sine[slid])
        return false;
    const Vec3 unit = n / sine, // over that of the fade angle
        v = velocity(first, contact.along) - velocity(second, contact.s);
    const float out = std::fabs(dot(v, unit)), in = length(v - unit * dot(v, unit));
    return !(out > std::max(limits_.tangent[slid] * in, limits_.speed[slid]));
}

/// Puts together what the chunks found.
void WispDetection::collect() {
    std::size_t axes = 0;
    for (const Found& found : chunks_)
        axes += found.axes.size();
    make_room(list_.axes, axes);
    auto next = list_.axes.begin();
    friction_contacts_ = intersecting_pairs_ = 0;
    for (const Found& found : chunks_) {
        next = std::copy(found.axes.begin(), found.axes.end(), next);
        friction_contacts_ += found.points.number.size() + found.along.number.size();
        intersecting_pairs_ += found.pairs;
    }
}

/// The segments of which a point was found in a segment.
std::span<const std::uint32_t> WispDetection::met_by(std::size_t index) const {
    const std::vector<std::uint32_t>& met = chunks_[index / kSegmentsPerChunk].met;
    const bool last = index + 1 == segments_.size() || (index + 1) % kSegmentsPerChunk == 0;
    const std::size_t end = last ? met.size() : first_met_[index + 1];
    return std::span(met).subspan(first_met_[index], end - first_met_[index]);
}

/// Each pair once: from the segment that has a point of the other inside; where both have, from the
/// earlier one.
void WispDetection::count_pairs(std::size_t chunk) {
    Found& found = chunks_[chunk];
    const std::size_t first = chunk * kSegmentsPerChunk,
                      last = std::min(segments_.size(), first + kSegmentsPerChunk);
    for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
        for (const std::uint32_t other : met_by(i)) {
            if (other == kNone)
                break;
            found.pairs += other > i || !has(met_by(other), i);
        }
    }
}

} // namespace mane
