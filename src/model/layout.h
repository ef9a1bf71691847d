#pragma once

#include "base/aligned.h"
#include "mane/groom.h"
#include "mane/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Lanes of a packet: sixteen wisps are stepped side by side, one per SIMD lane, whatever the width
/// of the machine's vectors.
inline constexpr std::uint32_t kLanes = 16;

/// Most envelope points that a cross-section may have.
inline constexpr std::uint32_t kMaxEnvelopePoints = 8;

/// Where a section lives: `row` (a section index of its packet) and `lane` (its wisp).
struct Slot {
    std::uint32_t row = 0;
    std::uint32_t lane = 0;
    bool operator==(const Slot&) const = default;
};

/// `C` numbers per section in packet order: row after row, component after component, sixteen lanes
/// side by side.
class Rows {
  public:
    Rows() = default;
    Rows(std::size_t rows, std::uint32_t components)
        : components_(components), data_(rows * components * kLanes) {}

    std::uint32_t components() const { return components_; }
    float* row(std::size_t r) { return data_.data() + r * components_ * kLanes; }
    const float* row(std::size_t r) const { return data_.data() + r * components_ * kLanes; }

    float& at(Slot s, std::uint32_t c = 0) { return row(s.row)[c * kLanes + s.lane]; }
    float at(Slot s, std::uint32_t c = 0) const { return row(s.row)[c * kLanes + s.lane]; }
    Vec3 vec(Slot s) const { return {at(s, 0), at(s, 1), at(s, 2)}; }
    void set(Slot s, const Vec3& v) { at(s, 0) = v.x, at(s, 1) = v.y, at(s, 2) = v.z; }
    void fill(float value) { std::fill(data_.begin(), data_.end(), value); }
    std::span<float> all() { return data_; }
    std::span<const float> all() const { return data_; }

  private:
    std::uint32_t components_ = 0;
    AlignedVector<float> data_;
};

/// Sixteen wisps with their sections as rows.
struct Packet {
    std::uint32_t first_row = 0;
    std::uint32_t rows = 0;                       ///< sections of its longest wisp, x₀ included
    std::array<std::uint32_t, kLanes> wisp{};     ///< kNoWisp where a lane is empty
    std::array<std::uint32_t, kLanes> sections{}; ///< per lane; 0 where empty
};

/// Which lane and row each section lives in. Wisps are sorted by their number of sections, so that
/// packets are full; of equally long ones those that lie together in the design are together.
class Layout {
  public:
    static constexpr std::uint32_t kNoWisp = 0xffffffffu;

    explicit Layout(const Groom& groom);

    std::span<const Packet> packets() const { return packets_; }
    std::size_t rows() const { return rows_; }
    /// Sections of the longest wisp.
    std::size_t most_rows() const { return packets_.empty() ? 0 : packets_.front().rows; }
    Slot slot(std::uint32_t section) const { return slots_[section]; }
    std::uint32_t wisp_of(std::uint32_t section) const { return wisp_of_[section]; }
    /// Whether the section is simulated: not x₀ and not x₁.
    bool simulated(std::uint32_t section) const { return simulated_[section] != 0; }

  private:
    std::vector<Packet> packets_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> wisp_of_;
    std::vector<std::uint8_t> simulated_;
    std::size_t rows_ = 0;
};

} // namespace mane
