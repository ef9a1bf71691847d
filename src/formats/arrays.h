#pragma once

#include "mane/vec.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mane {

static_assert(std::endian::native == std::endian::little, "caches are little-endian");

using Bytes = std::vector<std::byte>;

/// The numbers that an array is made of, as stored.
enum class Element : std::uint8_t { u8, u16, u32, u64, f32, f64 };
constexpr std::size_t element_size(Element e) {
    constexpr std::size_t kSizes[] = {1, 2, 4, 8, 4, 8};
    return kSizes[static_cast<std::size_t>(e)];
}

/// What one record of an array of T is stored as.
template <typename T> struct Record;
template <> struct Record<std::uint8_t> {
    static constexpr Element element = Element::u8;
    static constexpr std::uint8_t components = 1;
};
template <> struct Record<char> : Record<std::uint8_t> {};
template <> struct Record<std::uint16_t> {
    static constexpr Element element = Element::u16;
    static constexpr std::uint8_t components = 1;
};
template <> struct Record<std::uint32_t> {
    static constexpr Element element = Element::u32;
    static constexpr std::uint8_t components = 1;
};
template <> struct Record<std::uint64_t> {
    static constexpr Element element = Element::u64;
    static constexpr std::uint8_t components = 1;
};
template <> struct Record<float> {
    static constexpr Element element = Element::f32;
    static constexpr std::uint8_t components = 1;
};
template <> struct Record<double> {
    static constexpr Element element = Element::f64;
    static constexpr std::uint8_t components = 1;
};
template <typename T> struct Record<Vec3T<T>> {
    static constexpr Element element = Record<T>::element;
    static constexpr std::uint8_t components = 3;
};
template <typename T> struct Record<QuatT<T>> {
    static constexpr Element element = Record<T>::element;
    static constexpr std::uint8_t components = 4;
};
template <typename T, std::size_t N> struct Record<std::array<T, N>> {
    static constexpr Element element = Record<T>::element;
    static constexpr std::uint8_t components = N;
};

/// An array inside a payload.
struct ArrayInfo {
    std::string name;
    std::string unit;
    Element element = Element::u8;
    std::uint8_t components = 1; ///< numbers per record
    std::uint64_t count = 0;     ///< records
    std::size_t record_size() const { return element_size(element) * components; }
};

/// Builds a payload: a directory of the arrays, then their bytes, structure of arrays and bytes of
/// equal rank together.
class ArrayWriter {
  public:
    template <typename T>
    void add(std::string_view name, std::string_view unit, const std::vector<T>& values) {
        add(name, unit, std::span<const T>(values));
    }
    template <typename T>
    void add(std::string_view name, std::string_view unit, std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T> &&
                      sizeof(T) == element_size(Record<T>::element) * Record<T>::components);
        add_bytes({std::string(name), std::string(unit), Record<T>::element, Record<T>::components,
                   values.size()},
                  std::as_bytes(values));
    }
    template <typename T>
    void add_value(std::string_view name, std::string_view unit, const T& value) {
        add(name, unit, std::span<const T>(&value, 1));
    }
    Bytes payload() const;

  private:
    void add_bytes(const ArrayInfo& info, std::span<const std::byte> records);
    std::uint32_t count_ = 0;
    Bytes directory_, data_;
};

/// Takes a payload apart. Throws InputError "`where`: …" for one that breaks the format, or an
/// array that is missing or of another type.
class ArrayReader {
  public:
    ArrayReader(Bytes payload, std::string where);

    const std::vector<ArrayInfo>& arrays() const { return arrays_; }
    bool contains(std::string_view name) const;
    template <typename T> std::vector<T> get(std::string_view name) const {
        const std::size_t i = find(name, Record<T>::element, Record<T>::components);
        std::vector<T> values(arrays_[i].count);
        copy(i, std::as_writable_bytes(std::span<T>(values)));
        return values;
    }
    template <typename T> T get_value(std::string_view name) const {
        const std::vector<T> values = get<T>(name);
        if (values.size() != 1)
            fail("array \"" + std::string(name) + "\" has not one entry");
        return values[0];
    }
    [[noreturn]] void fail(const std::string& reason) const;

  private:
    std::size_t find(std::string_view name, Element element, std::uint8_t components) const;
    void copy(std::size_t array, std::span<std::byte> records) const;

    Bytes payload_;
    std::string where_;
    std::vector<ArrayInfo> arrays_;
    std::vector<std::size_t> offsets_;
};

} // namespace mane
