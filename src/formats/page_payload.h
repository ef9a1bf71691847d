#pragma once

#include "formats/arrays.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace mane {

/// The data of a page (docs/view.md): named arrays behind a directory in JSON, all packed by zlib's
/// deflate, which a browser undoes by itself.
class PagePayload {
  public:
    static constexpr char kMagic[8] = {'M', 'A', 'N', 'E', 'P', 'A', 'G', 'E'};
    static constexpr std::uint32_t kVersion = 1;

    /// What is not an array.
    nlohmann::ordered_json& header() { return header_; }

    void add(std::string_view name, std::span<const std::uint8_t> values);
    void add(std::string_view name, std::span<const std::uint16_t> values);
    void add(std::string_view name, std::span<const std::uint32_t> values);
    void add(std::string_view name, std::span<const float> values);
    void add(std::string_view name, std::span<const double> values);
    /// Whole numbers as planes of bytes of equal rank, those that are all zero left out.
    void add_planes(std::string_view name, std::span<const std::uint32_t> values);
    /// Rows of `row` whole numbers, one per frame, that stand for multiples of `quantum`: second
    /// differences from row to row, since what moves smoothly has small ones, as planes.
    void add_steps(std::string_view name, double quantum, std::size_t row,
                   std::span<const std::int32_t> values);

    /// Everything, packed.
    std::string packed() const;

  private:
    template <typename T>
    void add_numbers(std::string_view name, const char* type, std::span<const T> values);
    nlohmann::ordered_json& begin(std::string_view name, const char* type, std::size_t count);
    void append_planes(nlohmann::ordered_json& entry, std::span<const std::uint32_t> values);

    nlohmann::ordered_json header_, arrays_ = nlohmann::ordered_json::array();
    Bytes data_;
};

/// Packed by zlib's deflate.
std::string deflated(std::string_view bytes);
/// Text that stands for bytes in an HTML page (RFC 4648, with padding).
std::string base64(std::string_view bytes);

} // namespace mane
