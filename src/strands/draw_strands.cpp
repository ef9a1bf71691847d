#include "strands/draw_strands.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strands/draw_strands.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Where the lanes are along a wisp, and what they take of the control points around.
struct Along {
    Places piece;
    Pack weight[4];
    std::size_t tables;

    HWY_INLINE Along(Pack whole, std::uint32_t pieces)
        : piece(places(whole)), tables(tables_for(pieces + 1)) {}
    static HWY_INLINE Along grid(const VertexGrid& grid, std::size_t v, std::uint32_t pieces) {
        Along along(Pack::load_any(grid.piece() + v), pieces);
        for (std::size_t j = 0; j < 4; ++j)
            along.weight[j] = Pack::load_any(grid.weight(j) + v);
        return along;
    }
    static HWY_INLINE Along ends(const StrandRecipes& recipes, std::size_t n,
                                 std::uint32_t pieces) {
        Along along(Pack::load_any(recipes.end_piece.data() + n), pieces);
        for (std::size_t j = 0; j < 4; ++j)
            along.weight[j] = Pack::load_any(recipes.end_weight[j].data() + n);
        return along;
    }
    /// The curve whose control points are `row`.
    HWY_INLINE Pack on(const float* row) const {
        Pack sum = look_up(row, tables, piece) * weight[0];
        for (std::size_t j = 1; j < 4; ++j)
            sum = sum + look_up(row + j, tables, piece) * weight[j];
        return sum;
    }
};

/// How strands have their places in the disc: still, in one sector; or moving along the wisp, among
/// half lines at any angle or at right angles.
enum class Place { still, moving, moving_square };

/// How much half line k has in the point of the envelope that a disc point stands for: 0 outside
/// the two sectors beside it.
HWY_INLINE Pack share(const DrawnEnvelope::HalfLineForms& k, Pack x, Pack y) {
    const auto form = [&](DiscPoint f) { return Pack(f.x) * x + Pack(f.y) * y; };
    const Pack side = Pack(k.direction.x) * y - Pack(k.direction.y) * x;
    return larger(select(side < Pack(0.f), form(k.before), form(k.behind)), Pack(0.f));
}
/// The same among half lines at right angles: both forms are the part along the half line.
HWY_INLINE Pack share_at_right_angles(const DrawnEnvelope::HalfLineForms& k, Pack x, Pack y) {
    return larger(Pack(k.direction.x) * x + Pack(k.direction.y) * y, Pack(0.f));
}

/// The vertices of the grid, a pack at a time: each visited once or more, `body(v)` for those from
/// v on. `count` may be fewer than a pack.
template <typename Body> HWY_INLINE void for_packs(std::size_t count, Body&& body) {
    std::size_t v = 0;
    for (; v + kPackLanes <= count; v += kPackLanes)
        body(v);
    if (v < count) // the last ones again, rather than some beyond them
        body(count > kPackLanes ? count - kPackLanes : 0);
}

void lay_grid(const WispToDraw& wisp, GridRows& rows) {
    const std::uint32_t pieces = wisp.envelope.pieces(wisp.wisp);
    const std::size_t vertices = wisp.grid.vertices(pieces),
                      curves = 3 * (std::size_t{1} + wisp.envelope.half_lines());
    rows.stride = (vertices + kPackLanes - 1) / kPackLanes * kPackLanes;
    rows.rows.resize(rows.stride * curves);
    for (std::size_t v = 0; v < vertices; v += kPackLanes) {
        const Along along = Along::grid(wisp.grid, v, pieces);
        const float* control = wisp.envelope.control(wisp.wisp);
        for (std::size_t c = 0; c < curves; ++c, control += pieces + 3)
            along.on(control).store(rows.rows.data() + c * rows.stride + v);
    }
}

/// The ends of as many strands as a pack has lanes, from strand n = `first` + `some` on.
HWY_INLINE Pack3 ends(const WispToDraw& wisp, std::size_t first, std::size_t some) {
    const std::size_t n = first + some;
    const StrandRecipes& r = wisp.recipes;
    const std::uint32_t pieces = wisp.envelope.pieces(wisp.wisp);
    const Along along = Along::ends(r, n, pieces);
    Pack x = Pack::load_any(r.end_x.data() + n), y = Pack::load_any(r.end_y.data() + n);
    if (wisp.end_amplitude) {
        const Pack wave =
            Pack::load_any(wisp.end_amplitude + some) * Pack::load_any(r.end_wave.data() + n);
        x = x + wave * Pack(wisp.wave_direction.x);
        y = y + wave * Pack(wisp.wave_direction.y);
    }
    const float* row = wisp.envelope.control(wisp.wisp);
    const auto curve = [&] {
        const Pack3 p{along.on(row), along.on(row + pieces + 3), along.on(row + 2 * (pieces + 3))};
        row += 3 * (pieces + 3);
        return p;
    };
    Pack3 sum = curve();
    for (const DrawnEnvelope::HalfLineForms& k : wisp.envelope.forms()) {
        const Pack s = share(k, x, y);
        sum = sum + curve() * s;
    }
    return sum;
}

/// One strand at the vertices of its wisp's grid: in each lane one, from v on.
class StrandAtGrid {
  public:
    HWY_INLINE StrandAtGrid(const WispToDraw& wisp, const GridRows& rows, std::size_t n)
        : wisp_(wisp), recipes_(wisp.recipes), rows_(rows),
          pieces_(wisp.envelope.pieces(wisp.wisp)),
          left_(recipes_.left.data() + recipes_.first_left[wisp.wisp] +
                (n - wisp.first_strand) * (pieces_ + 3)),
          n_(n) {}

    template <Place kPlace> HWY_INLINE Pack3 at(std::size_t v) const {
        const Pack left =
            recipes_.jittered ? Along::grid(wisp_.grid, v, pieces_).on(left_) : Pack(1.f);
        return curve(0, v) + (kPlace == Place::still ? still(v) * left : moved<kPlace>(v, left));
    }

  private:
    HWY_INLINE Pack3 curve(std::size_t c, std::size_t v) const {
        const float* row = rows_.rows.data() + 3 * c * rows_.stride + v;
        return {Pack::load_any(row), Pack::load_any(row + rows_.stride),
                Pack::load_any(row + 2 * rows_.stride)};
    }

    // The control points are those of §5.2, the disc's point moved toward the skeleton by jitter
    // and linked by Catmull-Rom. What is interpolated is the share that jitter leaves, in the
    // interpolated section, and not the moved points: the same curve where neighbouring half lines
    // are equal, but the overshoot stays jitter/8 of the local radius beside a section that is
    // pressed flat, where interpolated points would leave the envelope (M17).
    HWY_INLINE Pack3 still(std::size_t v) const {
        const std::uint32_t k = recipes_.sector[n_];
        const std::uint32_t next = k + 1 < wisp_.envelope.half_lines() ? k + 1 : 0;
        return curve(1 + k, v) * Pack(recipes_.first[n_]) +
               curve(1 + next, v) * Pack(recipes_.second[n_]);
    }
    template <Place kPlace> HWY_INLINE Pack3 moved(std::size_t v, Pack left) const {
        Pack x = Pack(recipes_.first[n_]) * left, y = Pack(recipes_.second[n_]) * left;
        if (wisp_.curl_cosine) {
            const Pack c = Pack::load_any(wisp_.curl_cosine + v),
                       s = Pack::load_any(wisp_.curl_sine + v), turned = x * c - y * s;
            y = x * s + y * c;
            x = turned;
        }
        if (wisp_.wave_sine) {
            const Pack wave =
                Pack::load_any(wisp_.wave_sine + v) * Pack(recipes_.phase_cosine[n_]) +
                Pack::load_any(wisp_.wave_cosine + v) * Pack(recipes_.phase_sine[n_]);
            x = x + wave * Pack(wisp_.wave_direction.x);
            y = y + wave * Pack(wisp_.wave_direction.y);
        }
        const auto& forms = wisp_.envelope.forms();
        const auto part = [&](std::size_t k) {
            return curve(1 + k, v) * (kPlace == Place::moving_square
                                          ? share_at_right_angles(forms[k], x, y)
                                          : share(forms[k], x, y));
        };
        Pack3 sum = part(0);
        for (std::size_t k = 1; k < forms.size(); ++k)
            sum = sum + part(k);
        return sum;
    }

    const WispToDraw& wisp_;
    const StrandRecipes& recipes_;
    const GridRows& rows_;
    std::uint32_t pieces_;
    const float* left_;
    std::size_t n_;
};

/// The first `count` vertices of strand n, those of the grid.
template <Place kPlace> HWY_INLINE void draw_grid(const WispToDraw& wisp, const GridRows& rows,
                                                  std::size_t n, std::size_t count, Vec3* positions,
                                                  float* widths) {
    const StrandAtGrid strand(wisp, rows, n);
    const Pack root(wisp.root_width),
        thinner((wisp.tip_width - wisp.root_width) / wisp.recipes.end[n]);
    for_packs(count, [&](std::size_t v) {
        const Pack3 p = strand.at<kPlace>(v);
        const Pack width = root + thinner * Pack::load_any(wisp.grid.parameter() + v);
        if (v + kPackLanes <= count) {
            store_interleaved(p, &positions[v].x);
            width.store_any(widths + v);
            return;
        }
        Vec3 some_positions[kPackLanes];
        float some_widths[kPackLanes];
        store_interleaved(p, &some_positions[0].x);
        width.store_any(some_widths);
        std::copy_n(some_positions, count, positions);
        std::copy_n(some_widths, count, widths);
    });
}

template <Place kPlace> HWY_INLINE void draw_all(const WispToDraw& wisp, const GridRows& rows,
                                                 std::size_t first, std::size_t count,
                                                 Vec3* positions, float* widths) {
    const StrandRecipes& r = wisp.recipes;
    const std::size_t vertex = r.vertex[first];
    Vec3 end[kPackLanes];
    for (std::size_t n = first; n < first + count; ++n) {
        const std::size_t lane = (n - first) % kPackLanes;
        if (lane == 0)
            store_interleaved(ends(wisp, first, n - first), &end[0].x);
        const std::size_t begin = r.vertex[n] - vertex, last = r.vertex[n + 1] - vertex - 1;
        draw_grid<kPlace>(wisp, rows, n, last - begin, positions + begin, widths + begin);
        positions[last] = end[lane];
        widths[last] = wisp.tip_width;
    }
}

void draw(const WispToDraw& wisp, const GridRows& rows, std::size_t first, std::size_t count,
          Vec3* positions, float* widths) {
    if (!wisp.recipes.moving)
        draw_all<Place::still>(wisp, rows, first, count, positions, widths);
    else if (wisp.envelope.half_lines() == 4)
        draw_all<Place::moving_square>(wisp, rows, first, count, positions, widths);
    else
        draw_all<Place::moving>(wisp, rows, first, count, positions, widths);
}

StrandKernels kernels() {
    return {lay_grid, draw};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(kernels);

StrandKernels strand_kernels(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(kernels)();
}

} // namespace mane
#endif
