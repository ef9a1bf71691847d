#pragma once

#include "base/four.h"
#include "interactions/character_point.h"
#include "model/state.h"

#include <cstdint>
#include <vector>

namespace mane {

/// One number for each of the coordinates in which a section moves (docs/model.md): three for its
/// skeleton point, one for each radius, zeros behind. Of velocities, or of what belongs to them.
template <int kFours> struct SectionCoordinates {
    Four skeleton;
    Four radii[kFours];
};

/// How a wisp moves along one direction at one of its points. Everything that an answer asks of the
/// wisp is linear in its velocities, so it is worked out once for all sweeps: `takes` has the share
/// of every velocity in the point's own along the direction, and `gives`, after `weigh`, what an
/// impulse of 1 N·s along the direction changes in every velocity (M27).
template <int kFours> struct MotionRow {
    std::uint32_t section;  ///< the first
    std::uint32_t sections; ///< 2 between two sections
    SectionCoordinates<kFours> takes[2], gives[2];
};

/// Neighbouring sections of one wisp, unpacked: what the answers of sliding contacts read and
/// write, in Fours (kFours of them hold one number per half line). Sections are counted from x₀.
template <int kFours> class WispMotion {
  public:
    using Row = MotionRow<kFours>;

    /// The hair whose wisps are loaded from now on. It must live until the last was stored.
    void begin(const HairView& hair);
    /// Reads sections `first` to before `end` of wisp `number`; the others hold nothing.
    void load(std::uint32_t number, std::uint32_t first, std::uint32_t end);
    /// Writes the velocities that were changed.
    void store(State& state) const;

    Four position(const WispPoint& point) const;
    Four velocity(const WispPoint& axis_point) const;

    /// The velocity of a point along a direction, of any length.
    void find_row(const WispPoint& point, const Four& direction, Row& row) const;
    /// Finds what the row gives. Returns the inverse mass that an impulse meets [1/kg]: e·W e of
    /// docs/interactions.md.
    float weigh(Row& row) const;
    /// The velocity of the row's point along its direction now.
    float along(const Row& row) const;
    /// Answers an impulse [N·s] along the row's direction.
    void push(const Row& row, float impulse);

  private:
    struct Section {
        Four x, u, v; // the skeleton point, and the axes of the half lines
        Four radii[kFours];
        SectionCoordinates<kFours> velocities;
        bool changed = false;
    };
    /// Shares of the half lines, along both axes.
    struct Shares {
        Four u[kFours], v[kFours];
    };

    Slot slot(std::uint32_t section) const { return {root_.row + section, root_.lane}; }
    Shares shares(const WispPoint& point) const;
    float weigh(std::uint32_t section, const SectionCoordinates<kFours>& takes,
                SectionCoordinates<kFours>& gives) const;
    static void load_fours(const Rows& rows, Slot slot, Four* fours);

    const HairView* hair_ = nullptr;
    Shares half_lines_{}; // of each half line, the whole
    Slot root_;           // of x₀
    std::uint32_t first_ = 0, end_ = 0;
    std::vector<Section> sections_;
};

template <int kFours> inline auto WispMotion<kFours>::shares(const WispPoint& point) const
    -> Shares {
    const auto lines = static_cast<int>(hair_->half_lines.size()), k = static_cast<int>(point.k);
    const int next = k + 1 == lines ? 0 : k + 1;
    Shares shares;
    for (int f = 0; f < kFours; ++f) {
        const FourBits line = FourBits{0, 1, 2, 3} + 4 * f;
        const Four share =
            (line == k ? four(point.alpha) : Four{}) + (line == next ? four(point.beta) : Four{});
        shares.u[f] = half_lines_.u[f] * share;
        shares.v[f] = half_lines_.v[f] * share;
    }
    return shares;
}

template <int kFours> inline Four WispMotion<kFours>::position(const WispPoint& point) const {
    const Shares share = shares(point);
    Four sum{};
    for (std::uint32_t j = 0; j < point.sections(); ++j) {
        const Section& section = sections_[point.section + j];
        Four u{}, v{};
        for (int f = 0; f < kFours; ++f) {
            u += share.u[f] * section.radii[f];
            v += share.v[f] * section.radii[f];
        }
        sum += (section.x + section.u * four(sum_of(u)) + section.v * four(sum_of(v))) *
               four(point.weight(j));
    }
    return sum;
}

template <int kFours> inline Four WispMotion<kFours>::velocity(const WispPoint& axis_point) const {
    Four sum{};
    for (std::uint32_t j = 0; j < axis_point.sections(); ++j)
        sum += sections_[axis_point.section + j].velocities.skeleton * four(axis_point.weight(j));
    return sum;
}

template <int kFours> inline void
WispMotion<kFours>::find_row(const WispPoint& point, const Four& direction, Row& row) const {
    const Shares share = shares(point);
    row.section = point.section;
    row.sections = point.sections();
    for (std::uint32_t j = 0; j < row.sections; ++j) {
        const Section& section = sections_[row.section + j];
        SectionCoordinates<kFours>& takes = row.takes[j];
        takes.skeleton = direction * four(point.weight(j));
        const Four u = four(sum_of(section.u * takes.skeleton)),
                   v = four(sum_of(section.v * takes.skeleton));
        for (int f = 0; f < kFours; ++f)
            takes.radii[f] = share.u[f] * u + share.v[f] * v;
    }
}

template <int kFours> inline float WispMotion<kFours>::along(const Row& row) const {
    Four sum{};
    for (std::uint32_t j = 0; j < row.sections; ++j) {
        const SectionCoordinates<kFours>& now = sections_[row.section + j].velocities;
        sum += row.takes[j].skeleton * now.skeleton;
        for (int f = 0; f < kFours; ++f)
            sum += row.takes[j].radii[f] * now.radii[f];
    }
    return sum_of(sum);
}

template <int kFours> inline void WispMotion<kFours>::push(const Row& row, float impulse) {
    for (std::uint32_t j = 0; j < row.sections; ++j) {
        Section& section = sections_[row.section + j];
        section.velocities.skeleton += row.gives[j].skeleton * four(impulse);
        for (int f = 0; f < kFours; ++f)
            section.velocities.radii[f] += row.gives[j].radii[f] * four(impulse);
        section.changed = true;
    }
}

} // namespace mane
