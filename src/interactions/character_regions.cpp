#include "interactions/character_regions.h"

#include "character/box_tests.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// What is tried for a region's plane, one after the other: so much wider than half of the segments
/// and their envelope [m], and over the plane by this share of the surface's distance.
struct Plane {
    double spare;
    float over;
};
constexpr Plane kPlanes[] = {{0.04, 0.7f}, {0.02, 0.3f}, {0.01, 0.3f}, {0, 0.3f}};
constexpr double kWidest = kPlanes[0].spare, kUseful = kPlanes[1].spare;
/// Blocks until a region that is of no use is looked for again: twice as many after each time.
constexpr float kShortPause = 3, kLongPause = 48;
constexpr double kRounding = 1e-5; // [m] over that of single precision
constexpr float kFarthest = 1e3f;  // [m] nothing is known farther off

std::size_t slot_index(Slot slot) {
    return std::size_t{slot.row} * kLanes + slot.lane;
}

FrameMotion motion_of(const RigidFrame& from, const RigidFrame& to, double strayed) {
    FrameMotion m;
    const RigidFrame* ends[2] = {&from, &to};
    for (int end : {0, 1}) {
        const RigidFrame& frame = *ends[end];
        m.x[end] = Vec3(frame.x), m.y[end] = Vec3(frame.y), m.z[end] = Vec3(frame.z);
        m.origin[end] = Vec3(frame.origin);
    }
    // Where the world's axes and origin are taken.
    const auto carried = [&](const Vec3d& p) { return to.to_world(from.to_local(p)) - p; };
    const Vec3d shift = carried({}), x = carried({1, 0, 0}) - shift, y = carried({0, 1, 0}) - shift,
                z = carried({0, 0, 1}) - shift;
    m.turn_x = Vec3(x), m.turn_y = Vec3(y), m.turn_z = Vec3(z), m.shift = Vec3(shift);
    // A turn by θ parts places by 2 sin(θ/2) of their distance; the sum of squares is twice that
    // squared.
    m.turn = static_cast<float>(std::sqrt((dot(x, x) + dot(y, y) + dot(z, z)) / 2) + 1e-6);
    m.any = static_cast<float>(strayed);
    return m;
}

} // namespace

void CharacterRegions::begin(const HairView& hair, const Surface& surface) {
    const bool goes_on = surface_ == &surface && ended_ && block_ + 1 == surface.block() &&
                         jumps_ == surface.jumps() && groups_.size() == hair.layout.rows() * kLanes;
    if (!goes_on) {
        region_ = Rows(hair.layout.rows(), ClearRegion::count);
        groups_.assign(hair.layout.rows() * kLanes, 0);
        for (std::size_t row = 0; row < hair.layout.rows(); ++row)
            std::fill_n(region_.row(row), kLanes, -1.0f);
    }
    surface_ = &surface;
    block_ = surface.block();
    jumps_ = surface.jumps();
    ended_ = false;
    find_motion();
}

void CharacterRegions::find_motion() {
    const Drift& drift = surface_->drift();
    motion_.clear();
    for (std::size_t f = 0; f < drift.frames(); ++f)
        motion_.push_back(
            motion_of(surface_->start_frame(f), surface_->end_frame(f), double(drift.of_any(f))));
    find_boxes(surface_->start().tree());
}

void CharacterRegions::find_boxes(const TriangleTree& tree) {
    const auto groups = tree.groups();
    const Four nowhere = four(kFarthest);
    boxes_.assign((groups.size() + 3) / 4,
                  {{nowhere, nowhere, nowhere}, {nowhere, nowhere, nowhere}});
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto [low, high] = tree.bounds(groups[g]);
        FourBoxes& four = boxes_[g / 4];
        const float lows[3] = {low.x, low.y, low.z}, highs[3] = {high.x, high.y, high.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            four.low[axis][g % 4] = lows[axis];
            four.high[axis][g % 4] = highs[axis];
        }
    }
}

RegionQuestion CharacterRegions::question(const HairView& hair) {
    return {.layout = hair.layout,
            .state = hair.state,
            .frames = hair.frames,
            .half_lines = hair.half_lines,
            .region = region_,
            .motion = motion_,
            .duration = static_cast<float>(surface_->duration())};
}

void CharacterRegions::approach(const RegionTest& test, const HairView& hair, std::size_t packet,
                                double reach, float share, RegionTest::Approach* rows) {
    find_stray(hair.layout.packets()[packet]);
    RegionQuestion asked = question(hair);
    asked.reach = static_cast<float>(reach + kRounding);
    asked.share = share;
    test.approach(asked, packet, rows);
}

void CharacterRegions::stay(const RegionTest& test, const HairView& hair, std::size_t packet,
                            std::uint16_t* rows) {
    test.stay(question(hair), packet, rows);
}

void CharacterRegions::find_stray(const Packet& packet) {
    for (std::uint32_t row = packet.first_row; row < packet.first_row + packet.rows; ++row)
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const Slot slot{row, lane};
            const float frame = number(slot, ClearRegion::frame);
            if (frame >= 0)
                number(slot, ClearRegion::stray) = surface_->drift().of_groups(
                    static_cast<std::size_t>(frame), groups_[slot_index(slot)]);
        }
}

double CharacterRegions::Here::clear(const Vec3d& p) const {
    const double out = length(p - centre);
    return std::min(std::max(std::min(dot(normal, p) - height, radius - out), ball - out),
                    far - out) -
           kRounding;
}

CharacterRegions::Here CharacterRegions::here(Slot slot) const {
    const auto number = [&](std::uint32_t column) { return double(region_.at(slot, column)); };
    const auto vec = [&](std::uint32_t c) {
        return Vec3d{number(c), number(c + 1), number(c + 2)};
    };
    if (number(ClearRegion::frame) < 0)
        return {};
    const RigidFrame& frame =
        surface_->start_frame(static_cast<std::size_t>(number(ClearRegion::frame)));
    Here found;
    found.normal = frame.to_world(vec(ClearRegion::normal)) - frame.origin;
    found.centre = frame.to_world(vec(ClearRegion::centre));
    found.height = number(ClearRegion::height) + dot(found.normal, frame.origin);
    found.radius = number(ClearRegion::radius);
    found.ball = number(ClearRegion::ball);
    found.far = number(ClearRegion::far);
    return found;
}

void CharacterRegions::renew(Slot slot, const Vec3& x, double least, std::uint32_t& near,
                             bool nearest) {
    // A region that holds its section tells which side it is on; others are forgotten.
    const bool outside = number(slot, ClearRegion::frame) >= 0;
    number(slot, ClearRegion::frame) = -1;
    float& pause = number(slot, ClearRegion::pause);
    pause = std::max(pause, kShortPause);
    number(slot, ClearRegion::wait) = pause;
    pause = std::min(2 * pause, kLongPause);

    const PosedSurface& surface = surface_->start();
    const Vec3d p(x);
    const double most = least + kWidest;
    const std::optional<SurfacePlace> place =
        nearest ? surface.place_on(near, p) : surface.nearest(p, 2 * most, near);
    if (place)
        near = place->triangle;
    const double ball = (place ? std::sqrt(place->closest.squared) : 2 * most) - kRounding;
    if (ball < kRounding || (!outside && surface.inside(p)))
        return;
    Cap cap{.normal = {}, .radius = ball};
    if (ball < most)
        cap = cap_over(surface, x, Vec3(normalized(p - place->closest.point)),
                       static_cast<float>(ball), least);
    keep(slot, p, cap, ball, std::max(cap.radius, least + kUseful));
}

/// Minds what is no farther than `wide`, in the frame that this strays from least.
void CharacterRegions::keep(Slot slot, const Vec3d& p, const Cap& cap, double ball, double wide) {
    const Nearby nearby = groups_within(Vec3(p), static_cast<float>(wide));
    const Drift& drift = surface_->drift();
    std::size_t best = 0;
    for (std::size_t f = 1; f < drift.frames(); ++f) {
        if (drift.habit(f, nearby.groups) < drift.habit(best, nearby.groups))
            best = f;
    }
    groups_[slot_index(slot)] = nearby.groups;
    const RigidFrame& frame = surface_->start_frame(best);
    const auto put = [&](std::uint32_t first, const Vec3d& v) {
        number(slot, first) = static_cast<float>(v.x);
        number(slot, first + 1) = static_cast<float>(v.y);
        number(slot, first + 2) = static_cast<float>(v.z);
    };
    const Vec3d n(cap.normal);
    number(slot, ClearRegion::frame) = static_cast<float>(best);
    put(ClearRegion::centre, frame.to_local(p));
    put(ClearRegion::normal, frame.direction_to_local(n));
    number(slot, ClearRegion::height) = cap.height - static_cast<float>(dot(n, frame.origin));
    number(slot, ClearRegion::radius) = static_cast<float>(cap.radius - kRounding);
    number(slot, ClearRegion::ball) = static_cast<float>(ball);
    number(slot, ClearRegion::far) = nearby.far - static_cast<float>(kRounding);
    number(slot, ClearRegion::stray) = drift.of_groups(best, nearby.groups);
    number(slot, ClearRegion::age) = 0;
}

/// Tries planes over the nearest place of the surface, which is `distance` away from x.
CharacterRegions::Cap CharacterRegions::cap_over(const PosedSurface& surface, const Vec3& x,
                                                 const Vec3& normal, float distance, double least) {
    const float own = dot(normal, x);
    for (const Plane& plane : kPlanes) {
        const double radius = least + plane.spare;
        const BallHeights heights(normal, x, static_cast<float>(radius));
        const float highest = own - plane.over * distance,
                    roof = surface.roof(heights, own - distance, highest);
        if (roof <= highest)
            return {normal, roof + heights.slack + static_cast<float>(kRounding), radius};
    }
    return {.normal = normal, .radius = double(distance)};
}

CharacterRegions::Nearby CharacterRegions::groups_within(const Vec3& p, float radius) const {
    const Four at[3] = {four(p.x), four(p.y), four(p.z)}, minded = four(radius * radius);
    Nearby nearby;
    Four others = four(kFarthest * kFarthest);
    for (std::size_t n = 0; n < boxes_.size(); ++n) {
        Four squared{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Four gap = larger(
                larger(boxes_[n].low[axis] - at[axis], at[axis] - boxes_[n].high[axis]), Four{});
            squared += gap * gap;
        }
        for (const std::size_t g : Those(squared <= minded))
            nearby.groups |= std::uint64_t{1} << (4 * n + g);
        others = squared > minded ? smaller(others, squared) : others;
    }
    nearby.far = std::sqrt(std::min({others[0], others[1], others[2], others[3]}));
    return nearby;
}

} // namespace mane
