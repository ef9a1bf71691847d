// The one door to SIMD. A file with kernels names itself as HWY_TARGET_INCLUDE, includes
// hwy/foreach_target.h and then this file, and is compiled once per instruction set; `Pack` is then
// as many floats as that set's vectors hold, at most 16. Every operation is exact and rounds once
// (no fused multiply-add, no approximate reciprocal), so all sets give the same bits.
#if defined(MANE_BASE_PACK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_BASE_PACK_INL_H
#undef MANE_BASE_PACK_INL_H
#else
#define MANE_BASE_PACK_INL_H
#endif

#include "mane/vec.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;

struct Mask {
    hn::Mask<Tag> m;
};

struct Pack {
    hn::Vec<Tag> v;

    Pack() = default;
    HWY_INLINE Pack(hn::Vec<Tag> vector) : v(vector) {}
    HWY_INLINE Pack(float x) : v(hn::Set(Tag(), x)) {}
    static HWY_INLINE Pack load(const float* p) { return hn::Load(Tag(), p); }
    HWY_INLINE void store(float* p) const { hn::Store(v, Tag(), p); }
    /// Wherever `p` points.
    static HWY_INLINE Pack load_any(const float* p) { return hn::LoadU(Tag(), p); }
    HWY_INLINE void store_any(float* p) const { hn::StoreU(v, Tag(), p); }
    HWY_INLINE Pack operator-() const { return hn::Neg(v); }
};

inline constexpr std::size_t kPackLanes = hn::MaxLanes(Tag());

HWY_INLINE Pack operator+(Pack a, Pack b) {
    return hn::Add(a.v, b.v);
}
HWY_INLINE Pack operator-(Pack a, Pack b) {
    return hn::Sub(a.v, b.v);
}
HWY_INLINE Pack operator*(Pack a, Pack b) {
    return hn::Mul(a.v, b.v);
}
HWY_INLINE Pack operator/(Pack a, Pack b) {
    return hn::Div(a.v, b.v);
}
HWY_INLINE Pack square_root(Pack a) {
    return hn::Sqrt(a.v);
}
HWY_INLINE Mask operator<(Pack a, Pack b) {
    return {hn::Lt(a.v, b.v)};
}
HWY_INLINE Mask operator>(Pack a, Pack b) {
    return {hn::Gt(a.v, b.v)};
}
HWY_INLINE Mask operator<=(Pack a, Pack b) {
    return {hn::Le(a.v, b.v)};
}
HWY_INLINE Mask both(Mask a, Mask b) {
    return {hn::And(a.m, b.m)};
}
HWY_INLINE Mask either(Mask a, Mask b) {
    return {hn::Or(a.m, b.m)};
}
HWY_INLINE bool none(Mask m) {
    return hn::AllFalse(Tag(), m.m);
}
/// One bit per lane.
HWY_INLINE std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask.m, bytes);
    return bytes[0] | std::uint32_t{bytes[1]} << 8;
}
/// The other way round: of the lowest bits.
HWY_INLINE Mask mask_of(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits),
                                   static_cast<std::uint8_t>(bits >> 8)};
    return {hn::LoadMaskBits(Tag(), bytes)};
}
/// As many whole numbers.
struct Numbers {
    using D = hn::RebindToUnsigned<Tag>;
    hn::Vec<D> v;

    HWY_INLINE Numbers(hn::Vec<D> vector) : v(vector) {}
    HWY_INLINE explicit Numbers(std::uint32_t x) : v(hn::Set(D(), x)) {}
    static HWY_INLINE Numbers load_any(const std::uint32_t* p) { return hn::LoadU(D(), p); }
    /// From `first` on. (Highway's own writes them one by one and waits for them.)
    static HWY_INLINE Numbers counting(std::uint32_t first) {
        alignas(64) static constexpr std::uint32_t kCounting[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                    8, 9, 10, 11, 12, 13, 14, 15};
        return hn::Add(hn::Load(D(), kCounting), hn::Set(D(), first));
    }
};
HWY_INLINE Mask operator==(Numbers a, Numbers b) {
    return {hn::RebindMask(Tag(), hn::Eq(a.v, b.v))};
}
/// Where the mask holds `a`, elsewhere `b`.
HWY_INLINE Pack select(Mask m, Pack a, Pack b) {
    return hn::IfThenElse(m.m, a.v, b.v);
}
HWY_INLINE Pack select_or_zero(Mask m, Pack a) {
    return hn::IfThenElseZero(m.m, a.v);
}
HWY_INLINE Pack absolute(Pack a) {
    return hn::Abs(a.v);
}
// Sets differ in what Min and Max make of NaN and of zeros of both signs. Those of x86 do what is
// written out for the others.
#define MANE_X86_VECTORS (HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR)
HWY_INLINE Pack smaller(Pack a, Pack b) {
#if MANE_X86_VECTORS
    return hn::Min(a.v, b.v);
#else
    return select(a < b, a, b);
#endif
}
HWY_INLINE Pack larger(Pack a, Pack b) {
#if MANE_X86_VECTORS
    return hn::Max(a.v, b.v);
#else
    return select(a > b, a, b);
#endif
}
#undef MANE_X86_VECTORS
/// Tiny values become zero: denormals would slow some machines down and are flushed by others
/// (M39).
HWY_INLINE Pack without_tiny(Pack a) {
    return select_or_zero(absolute(a) > Pack(1e-15f), a);
}

/// 1/√x for normal x, relative error under 2e-7, without the divider, which is what the forces
/// would wait for; finite for x = 0. A first guess from the bits of x, a step of Newton's and one
/// of third order, the same on every machine. Each is scaled so that its highest power needs no
/// factor: up to (3/8)^⅕ / √x, and from there.
HWY_INLINE Pack inverse_square_root(Pack x) {
    const hn::RebindToSigned<Tag> i;
    const auto bits = hn::BitCast(i, x.v);
    const Pack guess = hn::BitCast(Tag(), hn::Sub(hn::Set(i, 0x5f01047e), hn::ShiftRight<1>(bits)));
    const Pack y = guess * (Pack(1.659603f) - x * guess * guess), a = x * y * y;
    return y * (Pack(2.28136706f) + a * (a - Pack(2.25160122f)));
}

/// The reciprocals of four numbers whose product is a normal number, by one division.
struct FourReciprocals {
    Pack of[4];
    HWY_INLINE FourReciprocals(Pack a, Pack b, Pack c, Pack d) {
        const Pack ab = a * b, cd = c * d, inverse = Pack(1.f) / (ab * cd);
        const Pack inverse_ab = inverse * cd, inverse_cd = inverse * ab;
        of[0] = inverse_ab * b;
        of[1] = inverse_ab * a;
        of[2] = inverse_cd * d;
        of[3] = inverse_cd * c;
    }
};

struct Pack3 {
    Pack x, y, z;

    /// Component rows of 16 lanes, side by side.
    static HWY_INLINE Pack3 load(const float* p) {
        return {Pack::load(p), Pack::load(p + 16), Pack::load(p + 32)};
    }
    HWY_INLINE void store(float* p) const {
        x.store(p);
        y.store(p + 16);
        z.store(p + 32);
    }
    HWY_INLINE Pack3 operator-() const { return {-x, -y, -z}; }
};

/// The same vector in all lanes.
HWY_INLINE Pack3 broadcast(const Vec3& v) {
    return {Pack(v.x), Pack(v.y), Pack(v.z)};
}
HWY_INLINE Pack3 operator+(Pack3 a, Pack3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Pack3 operator-(Pack3 a, Pack3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Pack3 operator*(Pack3 a, Pack s) {
    return {a.x * s, a.y * s, a.z * s};
}
HWY_INLINE Pack dot(Pack3 a, Pack3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Pack3 cross(Pack3 a, Pack3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Pack3 select(Mask m, Pack3 a, Pack3 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
HWY_INLINE Pack3 select_or_zero(Mask m, Pack3 a) {
    return {select_or_zero(m, a.x), select_or_zero(m, a.y), select_or_zero(m, a.z)};
}
HWY_INLINE Pack3 without_tiny(Pack3 a) {
    return {without_tiny(a.x), without_tiny(a.y), without_tiny(a.z)};
}

/// A vector of a plane, by its parts along the plane's two axes.
struct Pack2 {
    Pack u, v;

    static HWY_INLINE Pack2 load(const float* p) { return {Pack::load(p), Pack::load(p + 16)}; }
    HWY_INLINE void store(float* p) const {
        u.store(p);
        v.store(p + 16);
    }
};

HWY_INLINE Pack2 operator+(Pack2 a, Pack2 b) {
    return {a.u + b.u, a.v + b.v};
}
HWY_INLINE Pack2 operator-(Pack2 a, Pack2 b) {
    return {a.u - b.u, a.v - b.v};
}
HWY_INLINE Pack2 operator*(Pack2 a, Pack s) {
    return {a.u * s, a.v * s};
}
HWY_INLINE Pack dot(Pack2 a, Pack2 b) {
    return a.u * b.u + a.v * b.v;
}
/// The cross product's part across the plane.
HWY_INLINE Pack wedge(Pack2 a, Pack2 b) {
    return a.u * b.v - a.v * b.u;
}

#if HWY_TARGET == HWY_AVX3
/// Which lanes of x (0 to 15) and y (16 on), and then of that and z, stand where in the three
/// vectors that hold x, y, z lane by lane.
struct InterleavedLanes {
    alignas(64) std::int32_t of_xy[3][16] = {};
    alignas(64) std::int32_t of_z[3][16] = {};

    constexpr InterleavedLanes() {
        for (int vector = 0; vector < 3; ++vector)
            for (int lane = 0; lane < 16; ++lane) {
                const int place = 16 * vector + lane, component = place % 3, from = place / 3;
                of_xy[vector][lane] = component == 1 ? 16 + from : from;
                of_z[vector][lane] = component == 2 ? 16 + from : lane;
            }
    }
};
inline constexpr InterleavedLanes kInterleaved;
#endif

/// Writes x, y, z of one lane after the other.
HWY_INLINE void store_interleaved(const Pack3& p, float* to) {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_WASM // two thirds of the shuffles of Highway's
    const auto x = p.x.v.raw, y = p.y.v.raw, z = p.z.v.raw;
    const auto put = [to](std::size_t i, auto four) {
        hn::StoreU(hn::Vec<Tag>{four}, Tag(), to + 4 * i);
    };
    put(0, __builtin_shufflevector(__builtin_shufflevector(x, y, 0, 4, 1, 1), z, 0, 1, 4, 2));
    put(1, __builtin_shufflevector(__builtin_shufflevector(y, z, 1, 5, 2, 2), x, 0, 1, 6, 2));
    put(2, __builtin_shufflevector(__builtin_shufflevector(z, x, 2, 7, 3, 3), y, 0, 1, 7, 2));
#elif HWY_TARGET == HWY_AVX3 // a third
    for (int i = 0; i < 3; ++i) {
        const __m512 xy =
            _mm512_permutex2var_ps(p.x.v.raw, _mm512_load_si512(kInterleaved.of_xy[i]), p.y.v.raw);
        _mm512_storeu_ps(to + 16 * i, _mm512_permutex2var_ps(
                                          xy, _mm512_load_si512(kInterleaved.of_z[i]), p.z.v.raw));
    }
#else
    hn::StoreInterleaved3(p.x.v, p.y.v, p.z.v, Tag(), to);
#endif
}

/// The whole part of numbers from 0 to 2³¹.
HWY_INLINE Pack whole_part(Pack a) {
    return hn::Floor(a.v);
}

using Whole = hn::RebindToSigned<Tag>;

/// Which lane of a vector comes where.
#if HWY_TARGET == HWY_WASM // Highway goes through memory there, byte by byte
class Lanes {
  public:
    HWY_INLINE explicit Lanes(hn::Vec<Whole> from)
        : bytes_(
              hn::Add(hn::Mul(from, hn::Set(Whole(), 0x04040404)), hn::Set(Whole(), 0x03020100))) {}
    HWY_INLINE Pack of(Pack a) const {
        return hn::Vec<Tag>{wasm_i8x16_swizzle(a.v.raw, bytes_.raw)};
    }

  private:
    hn::Vec<Whole> bytes_;
};
#else
class Lanes {
  public:
    HWY_INLINE explicit Lanes(hn::Vec<Whole> from) : from_(hn::IndicesFromVec(Tag(), from)) {}
    HWY_INLINE Pack of(Pack a) const { return hn::TableLookupLanes(a.v, from_); }

  private:
    decltype(hn::IndicesFromVec(Tag(), hn::Zero(Whole()))) from_;
};
#endif

/// Where the lanes look in a table: `whole` numbers, which may lie in any of the vectors that hold
/// it.
struct Places {
    Pack whole;
    Lanes in_vector;
};
HWY_INLINE Places places(Pack whole) {
    return {whole,
            Lanes(hn::And(hn::ConvertTo(Whole(), whole.v), hn::Set(Whole(), int{kPackLanes - 1})))};
}
/// How many vectors hold a table of `entries`.
HWY_INLINE std::size_t tables_for(std::size_t entries) {
    return (entries + kPackLanes - 1) / kPackLanes;
}
/// table[place] in each lane. All of the `vectors` are read, whatever is looked up.
HWY_INLINE Pack look_up(const float* table, std::size_t vectors, const Places& place) {
    Pack found = place.in_vector.of(Pack::load_any(table));
    for (std::size_t n = 1; n < vectors; ++n) {
        const Pack next = place.in_vector.of(Pack::load_any(table + n * kPackLanes));
        found = select(place.whole < Pack(static_cast<float>(n * kPackLanes)), found, next);
    }
    return found;
}

/// The lanes where a mask holds, one after the other. Stored, what follows them is written over: a
/// whole vector, wherever it is.
#if HWY_TARGET == HWY_AVX3
class Packing {
  public:
    HWY_INLINE explicit Packing(Mask mask) : mask_(mask.m) {}
    HWY_INLINE std::size_t count() const { return hn::CountTrue(Tag(), mask_); }
    HWY_INLINE void store(Pack a, float* p) const { Pack(hn::Compress(a.v, mask_)).store_any(p); }
    HWY_INLINE void store(Numbers a, std::uint32_t* p) const {
        const Numbers::D d;
        hn::StoreU(hn::Compress(a.v, hn::RebindMask(d, mask_)), d, p);
    }

  private:
    hn::Mask<Tag> mask_;
};
#else
/// For each set of lanes, which one comes where.
struct PackedLanes {
    alignas(64) std::uint8_t lane[std::size_t{1} << kPackLanes][kPackLanes] = {};

    constexpr PackedLanes() {
        for (std::size_t bits = 0; bits < std::size_t{1} << kPackLanes; ++bits)
            for (std::size_t from = 0, to = 0; from < kPackLanes; ++from)
                if ((bits >> from & 1) != 0)
                    lane[bits][to++] = static_cast<std::uint8_t>(from);
    }
};
inline constexpr PackedLanes kPackedLanes; // GCC copies Highway's own to the stack at every call
class Packing {
  public:
    HWY_INLINE explicit Packing(Mask mask) : Packing(bits_of(mask)) {}
    HWY_INLINE std::size_t count() const { return count_; }
    HWY_INLINE void store(Pack a, float* p) const { lanes_.of(a).store_any(p); }
    HWY_INLINE void store(Numbers a, std::uint32_t* p) const {
        const Numbers::D d;
        hn::StoreU(hn::BitCast(d, lanes_.of(hn::BitCast(Tag(), a.v)).v), d, p);
    }

  private:
    HWY_INLINE explicit Packing(std::uint32_t bits)
        : count_(hwy::PopCount(bits)),
          lanes_(hn::PromoteTo(
              Whole(), hn::Load(hn::Rebind<std::uint8_t, Tag>(), kPackedLanes.lane[bits]))) {}

    std::size_t count_;
    Lanes lanes_;
};
#endif

/// x to the power p for x > 0, relative error under 3e-6 for results between 1e-3 and 1e3.
HWY_INLINE Pack power(Pack x, Pack p) {
    const Tag f;
    const hn::RebindToSigned<Tag> i;
    // x = m 2^e with m in [√½, √2): log₂ x = e + the odd series in (m−1)/(m+1).
    const auto bits = hn::BitCast(i, x.v);
    const auto shifted = hn::Sub(bits, hn::Set(i, 0x3f3504f3));
    const Pack e = hn::ConvertTo(f, hn::ShiftRight<23>(shifted));
    const Pack m =
        hn::BitCast(f, hn::Add(hn::And(shifted, hn::Set(i, 0x007fffff)), hn::Set(i, 0x3f3504f3)));
    const Pack h = (m - Pack(1.f)) / (m + Pack(1.f)), y = h * h;
    const Pack series = ((Pack(0.43182930f) * y + Pack(0.57671107f)) * y + Pack(0.96179888f)) * y +
                        Pack(2.88539008f);
    const Pack exponent = smaller(larger(p * (e + h * series), Pack(-120.f)), Pack(120.f));
    const Pack n = hn::Floor((exponent + Pack(0.5f)).v);
    const Pack r = exponent - n;
    Pack q = Pack(1.54614447e-4f);
    for (float c :
         {1.34004282e-3f, 9.61805668e-3f, 5.55032723e-2f, 0.240226509f, 0.693147207f, 1.f})
        q = q * r + Pack(c);
    const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(i, n.v), hn::Set(i, 127)));
    return q * Pack(hn::BitCast(f, scale));
}

/// A polynomial, the coefficient of the highest power first.
template <std::size_t kCount>
HWY_INLINE Pack polynomial(const float (&coefficients)[kCount], Pack x) {
    Pack sum(coefficients[0]);
    for (std::size_t i = 1; i < kCount; ++i)
        sum = sum * x + Pack(coefficients[i]);
    return sum;
}

/// The bend by the angle θ between two unit vectors, see docs/model.md.
struct Bend {
    Pack curvature; ///< θ / sin(θ/2)
    Pack cotangent; ///< q = (θ/2) cot(θ/2)
    Pack remainder; ///< (1 − q) / sin²(θ/2)
};
/// From `cosine` = cos(θ/2), in which all three are smooth up to 180° and beyond. Relative error
/// under 1e-6.
HWY_INLINE Bend bend(Pack cosine) {
    const Pack x = Pack(1.f) - cosine;
    Pack g =
        polynomial({0.07228555054f, 0.10835522162f, 0.2673093274f, 0.6666426806f, 2.000000142f}, x);
    Pack r =
        polynomial({0.08861926584f, 0.09302610844f, 0.1723515176f, 0.266632634f, 0.3333335305f}, x);
    const Mask sharp = cosine < Pack(0.70710678f); // beyond 90°
    if (!none(sharp)) [[unlikely]] {
        g = select(sharp,
                   polynomial({0.02271480918f, -0.06691514126f, 0.1051580858f, -0.0703025204f,
                               0.061971814f, 0.03969720662f, 0.1160754462f, 0.2665217634f,
                               0.666671177f, 1.999999977f},
                              x),
                   g);
        r = select(
            sharp,
            polynomial({0.07243788897f, -0.219574157f, 0.331659694f, -0.2394384218f, 0.1530478873f,
                        0.02395799282f, 0.1068826837f, 0.171013908f, 0.2666790701f, 0.333333273f},
                       x),
            r);
    }
    return {g, g * (Pack(0.5f) * cosine), r};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
