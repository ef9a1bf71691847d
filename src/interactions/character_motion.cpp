#include "interactions/character_motion.h"

#include "interactions/impulse.h"

namespace mane {

template <int kFours> void WispMotion<kFours>::begin(const HairView& hair) {
    hair_ = &hair;
    half_lines_ = {};
    for (std::uint32_t line = 0; line < hair.half_lines.size(); ++line) {
        half_lines_.u[line / 4][line % 4] = hair.half_lines[line].cosine;
        half_lines_.v[line / 4][line % 4] = hair.half_lines[line].sine;
    }
}

template <int kFours>
void WispMotion<kFours>::load(std::uint32_t number, std::uint32_t first, std::uint32_t end) {
    root_ = hair_->layout.slot(hair_->groom.first_section[number]);
    first_ = first;
    end_ = end;
    if (sections_.size() < end)
        sections_.resize(end);
    for (std::uint32_t i = first; i < end; ++i) {
        Section& section = sections_[i];
        section.x = four(hair_->state.position.vec(slot(i)));
        section.u = four(hair_->frames.u.vec(slot(i)));
        section.v = four(hair_->frames.v.vec(slot(i)));
        load_fours(hair_->state.radius, slot(i), section.radii);
        section.velocities.skeleton = four(hair_->state.velocity.vec(slot(i)));
        load_fours(hair_->state.radius_rate, slot(i), section.velocities.radii);
        section.changed = false;
    }
}

template <int kFours>
void WispMotion<kFours>::load_fours(const Rows& rows, Slot slot, Four* fours) {
    const auto number = [&](std::uint32_t line) {
        return line < rows.components() ? rows.at(slot, line) : 0;
    };
    for (std::uint32_t f = 0; f < kFours; ++f)
        fours[f] = Four{number(4 * f), number(4 * f + 1), number(4 * f + 2), number(4 * f + 3)};
}

template <int kFours> void WispMotion<kFours>::store(State& state) const {
    const auto k = static_cast<std::uint32_t>(hair_->half_lines.size());
    for (std::uint32_t i = first_; i < end_; ++i) {
        const Section& section = sections_[i];
        if (!section.changed)
            continue;
        state.velocity.set(slot(i), first_three(section.velocities.skeleton));
        for (std::uint32_t line = 0; line < k; ++line)
            state.radius_rate.at(slot(i), line) = section.velocities.radii[line / 4][line % 4];
    }
}

template <int kFours> float WispMotion<kFours>::weigh(Row& row) const {
    float sum = 0;
    for (std::uint32_t j = 0; j < row.sections; ++j)
        sum += weigh(row.section + j, row.takes[j], row.gives[j]);
    return sum;
}

// The generalised coordinates are the skeleton's velocity ẋ and q = ṙ + ẋ·d of every envelope
// point; the kinetic energy is diagonal in them (docs/model.md). A point's velocity is (I − α d dᵀ
// − β d'd'ᵀ) ẋ + α d q + β d'q', so an impulse gives q its part along the half lines and ẋ the
// rest; a q that is not pushed stays, so ṙ takes up the skeleton's change.
template <int kFours> float WispMotion<kFours>::weigh(std::uint32_t i,
                                                      const SectionCoordinates<kFours>& takes,
                                                      SectionCoordinates<kFours>& gives) const {
    const SectionMass mass = SectionMass::of(*hair_, slot(i));
    if (mass.across == 0) {
        gives = SectionCoordinates<kFours>{};
        return 0;
    }
    const Section& section = sections_[i];
    Four along_u{}, along_v{};
    for (int f = 0; f < kFours; ++f) {
        along_u += half_lines_.u[f] * takes.radii[f];
        along_v += half_lines_.v[f] * takes.radii[f];
    }
    const Four rest =
        takes.skeleton - section.u * four(sum_of(along_u)) - section.v * four(sum_of(along_v));
    gives.skeleton = mass.skeleton_response(rest);
    const Four u = four(sum_of(section.u * gives.skeleton)),
               v = four(sum_of(section.v * gives.skeleton));
    Four work = takes.skeleton * gives.skeleton;
    for (int f = 0; f < kFours; ++f) {
        gives.radii[f] =
            takes.radii[f] * four(mass.envelope) - half_lines_.u[f] * u - half_lines_.v[f] * v;
        work += takes.radii[f] * gives.radii[f];
    }
    return sum_of(work);
}

template class WispMotion<1>;
template class WispMotion<2>;

} // namespace mane
