#include "interactions/character_regions.h"

#include "base/four.h"
#include "character/box_tests.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mane {
namespace {

/// [m] A region is found by so much wider than it is of use at once.
constexpr double kSpare = 0.02;
/// Blocks until a region that was not found is looked for again.
constexpr float kWait = 12;
/// And one that was.
constexpr float kPause = 3;
/// A plane is taken where the section is over it by this share of the surface's distance; in the
/// smaller ball, by the second.
constexpr float kGoodPlane = 0.7f, kUsefulPlane = 0.3f;
constexpr double kRounding = 1e-5; // [m] over that of single precision

float squared_distance(const TriangleTree::Box& box, const Vec3& p) {
    const Four at = four(p), gap = larger(larger(four(box.low) - at, at - four(box.high)), Four{});
    return dot(gap, gap);
}

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
    const TriangleTree& tree = surface_->start().tree();
    boxes_.clear();
    for (const TriangleTree::Group& group : tree.groups())
        boxes_.push_back(tree.bounds(group));
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

void CharacterRegions::renew(Slot slot, const Vec3& x, double wanted,
                             std::uint32_t& near_triangle) {
    // A region that holds its section tells which side it is on; others are forgotten.
    const bool outside = number(slot, ClearRegion::frame) >= 0;
    number(slot, ClearRegion::frame) = -1;
    number(slot, ClearRegion::wait) = kWait;
    const PosedSurface& surface = surface_->start();
    const Vec3d p(x);
    const double most = wanted + kSpare;
    const std::optional<SurfacePlace> near = surface.nearest(p, 2 * most, near_triangle);
    if (near)
        near_triangle = near->triangle;
    const double ball = (near ? std::sqrt(near->closest.squared) : 2 * most) - kRounding;
    if (ball < kRounding || (!outside && surface.inside(p)))
        return;
    Vec3 normal;
    float height = 1e30f; // no plane
    double radius = ball;
    if (ball < most) {
        const auto distance = static_cast<float>(ball);
        normal = Vec3(normalized(p - near->closest.point));
        const float own = dot(normal, x);
        for (const auto& [size, share] : {std::pair(most, kGoodPlane), {wanted, kUsefulPlane}}) {
            const auto half = static_cast<float>(size);
            const BoxHeights heights(normal,
                                     {x - Vec3(half, half, half), x + Vec3(half, half, half)});
            const float highest = own - share * distance,
                        roof = surface.roof(heights, own - distance, highest);
            if (roof > highest)
                continue;
            radius = size;
            height = roof + heights.slack + static_cast<float>(kRounding);
            break;
        }
    }

    std::uint64_t groups = 0;
    float squared_far = 1e6f;
    const double wide = std::max(radius, wanted);
    const auto minded = static_cast<float>(wide * wide);
    for (std::size_t g = 0; g < boxes_.size(); ++g) {
        const float squared = squared_distance(boxes_[g], x);
        if (squared <= minded)
            groups |= std::uint64_t{1} << g;
        else
            squared_far = std::min(squared_far, squared);
    }
    const double far = std::sqrt(double(squared_far));
    const Drift& drift = surface_->drift();
    std::size_t best = 0;
    for (std::size_t f = 1; f < drift.frames(); ++f) {
        if (drift.habit(f, groups) < drift.habit(best, groups))
            best = f;
    }
    groups_[slot_index(slot)] = groups;
    const RigidFrame& frame = surface_->start_frame(best);
    const auto put = [&](std::uint32_t first, const Vec3d& v) {
        number(slot, first) = static_cast<float>(v.x);
        number(slot, first + 1) = static_cast<float>(v.y);
        number(slot, first + 2) = static_cast<float>(v.z);
    };
    const Vec3d n(normal);
    number(slot, ClearRegion::frame) = static_cast<float>(best);
    put(ClearRegion::centre, frame.to_local(p));
    put(ClearRegion::normal, frame.direction_to_local(n));
    number(slot, ClearRegion::height) = height - static_cast<float>(dot(n, frame.origin));
    number(slot, ClearRegion::radius) = static_cast<float>(radius - kRounding);
    number(slot, ClearRegion::ball) = static_cast<float>(ball);
    number(slot, ClearRegion::far) = static_cast<float>(far - kRounding);
    number(slot, ClearRegion::stray) = drift.of_groups(best, groups);
    number(slot, ClearRegion::age) = 0;
    number(slot, ClearRegion::wait) = kPause;
}

} // namespace mane
