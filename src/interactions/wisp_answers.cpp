#include "interactions/wisp_answers.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/wisp_answers.cpp"
#include <hwy/foreach_target.h>

#include "base/blocks-inl.h"
#include "interactions/contact_matrix-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Inverse masses of a segment's ends; held ones have none.
struct SegmentMatrices {
    SymmetricOf<double> near, far;
    bool near_held, far_held;
};
inline bool is_held(const WispAnswers& a, std::size_t rank) {
    return a.inverse_mass[rank].across == 0;
}

/// Contacts of one segment, at most N at a time.
template <std::size_t N> class MatrixLanes {
  public:
    using R = Reals<N>;
    using R3 = Reals3<N>;

    HWY_INLINE MatrixLanes(const ContactPoints& points, WispAnswers& answers, std::size_t slot)
        : p(points), a(answers), slot_(slot) {
        for (std::size_t i = 0; i < R::kCount; ++i)
            section_[i] = a.point[slot + i] / 16;
    }

    /// W of a point of a section (not of an axis), but for the contact's weight; its direction.
    HWY_INLINE void add_point(Symmetrics<N>& w, R3& direction) {
        const std::uint32_t* place = a.place.data() + slot_;
        direction = gather(p.normal, section_);
        const R3 half_line = gather(p.half_line, place);
        add_identity(w, R::gather(a.shared_across.data(), section_, 1));
        add_outer(w, direction, R::gather(a.shared_extra.data(), section_, 1));
        add_outer(w, half_line, R::gather(a.shared_envelope.data(), place, 1));
    }

    /// W of a segment, (1 − s)² and s² of its ends; 1 − s and s of an end whose other one is held
    /// (docs/model.md).
    HWY_INLINE void add_segment(Symmetrics<N>& w, const SegmentMatrices& segment) {
        s_ = along_segment();
        const R rest = R(1.0) - s_;
        add(w, segment.near, segment.far_held ? rest : rest * rest);
        add(w, segment.far, segment.near_held ? s_ : s_ * s_);
    }

    /// Where only the envelope of a pinned section can give way, W has the direction of its half
    /// line alone and no inverse: as much in all directions, and it gives way by half.
    HWY_INLINE void soften_between_held(Symmetrics<N>& w) const {
        const R across = R::gather(a.shared_across.data(), section_, 1);
        add_identity(w, select(across > R(0.0), R(0.0), w.xx + w.yy + w.zz));
    }

    HWY_INLINE void store(Symmetrics<N> w, const R3& point, const R3& segment) {
        const R trace = w.xx + w.yy + w.zz;
        const R drag =
            viscosity_of_drag(R::load(a.density.data() + slot_) * R(a.friction * double{a.step}));
        if (!(drag > R(0.0)).none())
            add_viscosity(w, point, segment, trace * R(1.0 / 3), drag, a);
        const Symmetrics<N> m = inverse(w, trace, -R::load(a.weight.data() + slot_));
        R::store_fours(m.xx, m.yy, m.zz, s_, a.diagonal.data() + slot_);
        R::store_fours(m.xy, m.yz, m.xz, R(0.0), a.beside.data() + slot_);
    }

    static HWY_INLINE R3 same(const Four& v) { return {double{v[0]}, double{v[1]}, double{v[2]}}; }

  private:
    HWY_INLINE R along_segment() const {
        static constexpr std::uint32_t kCounting[8] = {0, 1, 2, 3, 4, 5, 6, 7};
        return R::gather(reinterpret_cast<const float*>(a.diagonal.data() + slot_) + 3, kCounting,
                         4);
    }
    static HWY_INLINE R3 gather(const AlignedVector<Four>& x, const std::uint32_t* at) {
        const float* base = reinterpret_cast<const float*>(x.data());
        return {R::gather(base, at, 4), R::gather(base + 1, at, 4), R::gather(base + 2, at, 4)};
    }

    const ContactPoints& p;
    WispAnswers& a;
    std::size_t slot_;
    std::uint32_t section_[R::kCount]; // the points' ranks
    R s_;                              // along the segment
};

/// Inverse masses of a section as its contacts share them.
inline SymmetricOf<double> shared_matrix(const ContactPoints& p, const WispAnswers& a,
                                         std::size_t rank) {
    SymmetricOf<double> m{};
    const Four& n = p.normal[rank];
    add_identity(m, double{a.shared_across[rank]});
    add_outer(m, Vec3d(first_three(n)), double{a.shared_extra[rank]});
    return m;
}

template <std::size_t N>
HWY_INLINE void find_point_matrices(const ContactPoints& p, WispAnswers& a, std::size_t rank,
                                    const SegmentMatrices& segment, std::size_t slot) {
    MatrixLanes<N> lanes(p, a, slot);
    Symmetrics<N> w{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    Reals3<N> direction;
    lanes.add_point(w, direction);
    lanes.add_segment(w, segment);
    if (segment.near_held && segment.far_held)
        lanes.soften_between_held(w);
    lanes.store(w, direction, lanes.same(p.direction[rank]));
}

/// A contact of two axes: both sides as segments. They are few, so one at a time.
inline void find_axis_matrix(const ContactPoints& p, WispAnswers& a, std::size_t rank,
                             const SegmentMatrices& segment, std::size_t slot) {
    const AxisPoint& point = a.axis_points[a.place[slot] - p.places()];
    const double along = double{point.along}, rest = 1 - along;
    MatrixLanes<1> lanes(p, a, slot);
    Symmetrics<1> w{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const std::uint32_t next = p.order.next(point.rank);
    add<1>(w, shared_matrix(p, a, point.rank), is_held(a, next) ? rest : rest * rest);
    add<1>(w, shared_matrix(p, a, next), is_held(a, point.rank) ? along : along * along);
    lanes.add_segment(w, segment);
    lanes.store(w, lanes.same(p.direction[point.rank]), lanes.same(p.direction[rank]));
}

void find_matrices(const ContactPoints& p, WispAnswers& a, std::size_t first, std::size_t last) {
    for (std::size_t rank = first; rank < last; ++rank) {
        if (a.first[rank] == a.first[rank + 1])
            continue;
        const std::uint32_t next = p.order.next(static_cast<std::uint32_t>(rank));
        const SegmentMatrices segment{shared_matrix(p, a, rank), shared_matrix(p, a, next),
                                      is_held(a, rank), is_held(a, next)};
        std::size_t slot = a.first[rank];
        for (; slot + Reals<8>::kCount <= a.first_axis[rank]; slot += Reals<8>::kCount)
            find_point_matrices<8>(p, a, rank, segment, slot);
        for (; slot < a.first_axis[rank]; slot += Reals<4>::kCount)
            find_point_matrices<4>(p, a, rank, segment, slot);
        for (; slot < a.first[rank + 1] && a.weight[slot] > 0; ++slot)
            find_axis_matrix(p, a, rank, segment, slot);
    }
}

/// Impulses of four contacts with a segment that moves like v + s·change; adds them, and their
/// parts at s, to the sums.
HWY_INLINE void find_four(const ContactPoints& p, WispAnswers& a, std::size_t slot, Blocks v,
                          Blocks change, FourBlocks& sum, FourBlocks& sum_at_s) {
    for (std::size_t part = 0; part < FourBlocks::kParts; ++part) {
        const std::size_t at = slot + part * Blocks::kCount;
        const Blocks diagonal = Blocks::load(a.diagonal.data() + at), s = diagonal.all<3>(),
                     beside = Blocks::load(a.beside.data() + at);
        const Blocks relative =
            Blocks::pick(p.velocity.data(), a.place.data() + at) - v - change * s;
        const Blocks j = diagonal * relative + beside * relative.turned<1>() +
                         beside.turned<2>() * relative.turned<2>();
        j.store(a.impulse.data() + at);
        sum.part[part] = sum.part[part] + j;
        sum_at_s.part[part] = sum_at_s.part[part] + j * s;
    }
}

void find_impulses(const ContactPoints& p, WispAnswers& a, std::size_t first, std::size_t last) {
    for (std::size_t rank = first; rank < last; ++rank) {
        if (a.first[rank] == a.first[rank + 1])
            continue;
        const auto begin = static_cast<std::uint32_t>(rank);
        const Four near = p.velocity[p.place(begin)],
                   change = p.velocity[p.place(p.order.next(begin))] - near;
        const Blocks near_blocks = Blocks::same(near), change_blocks = Blocks::same(change);
        FourBlocks sum = FourBlocks::zero(), at_s = FourBlocks::zero();
        for (std::size_t slot = a.first[rank]; slot < a.first[rank + 1]; slot += 4)
            find_four(p, a, slot, near_blocks, change_blocks, sum, at_s);
        const Four far = at_s.sum();
        a.far[rank] = -far;
        a.near[rank] = far - sum.sum();
    }
}

/// The impulses on a section: of its skeleton point, and along its half lines.
template <int kFours> struct SectionImpulse {
    Four skeleton;
    Four along[kFours];
};

template <int kFours> HWY_INLINE SectionImpulse<kFours>
gather_section(const ContactPoints& p, const WispAnswers& a, std::uint32_t rank) {
    Four at_point[1 + 4 * kFours] = {a.near[rank]}; // by code
    if (p.order.before(rank) != ContactOrder::kNone)
        at_point[0] += a.far[p.order.before(rank)];
    for (std::uint32_t i = a.at_section.first(rank); i < a.at_section.last(rank); ++i) {
        const std::uint32_t entry = a.entry[i];
        __builtin_prefetch(&a.impulse[a.entry[i + 24] / 16]);
        at_point[entry % 16] += a.impulse[entry / 16];
    }
    for (std::uint32_t i = a.axes_at.first(rank); i < a.axes_at.last(rank); ++i)
        at_point[0] += a.impulse[a.axis_share[i].slot] * four(a.axis_share[i].share);

    SectionImpulse<kFours> sum{at_point[0], {}};
    for (std::uint32_t k = 0; k + 1 < p.per_section; ++k) {
        const Four &d = p.half_line[p.place(rank, k + 1)], &j = at_point[k + 1];
        const float along = mane::dot(d, j);
        sum.along[k / 4][k % 4] = along;
        sum.skeleton += j - d * four(along);
    }
    return sum;
}

/// An envelope point takes the part along its half line, the skeleton point the rest (M27); the
/// others keep their own motion.
template <int kFours>
HWY_INLINE void change_section(const ContactPoints& p, WispAnswers& a, std::uint32_t rank) {
    const SectionImpulse<kFours> j = gather_section<kFours>(p, a, rank);
    const WispAnswers::InverseMass& mass = a.inverse_mass[rank];
    const Four& normal = p.normal[rank];
    const Four change =
        j.skeleton * four(mass.across) + normal * four(mane::dot(normal, j.skeleton) * mass.extra);
    a.change.skeleton[rank] = change;
    for (int f = 0; f < kFours; ++f) {
        Four follows{};
        for (std::uint32_t i = 0; i < 4 && 4 * f + i + 1 < p.per_section; ++i)
            follows[i] = mane::dot(p.half_line[p.place(rank, 4 * f + i + 1)], change);
        a.change.rate[rank * kFours + f] = j.along[f] * four(mass.envelope) - follows;
    }
}

template <int kFours>
void find_changes_of(const ContactPoints& p, WispAnswers& a, std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
        const auto rank = static_cast<std::uint32_t>(r);
        if (a.takes_part[rank] && !p.held[rank])
            change_section<kFours>(p, a, rank);
    }
}

void find_changes(const ContactPoints& p, WispAnswers& a, std::size_t first, std::size_t last) {
    (a.change.fours == 1 ? find_changes_of<1> : find_changes_of<2>)(p, a, first, last);
}

WispAnswerKernels wisp_answers() {
    return {find_matrices, find_impulses, find_changes};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(wisp_answers);

WispAnswerKernels wisp_answer_kernels(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(wisp_answers)();
}

} // namespace mane
#endif
