#include "formats/page_payload.h"

#include "mane/error.h"

#include <zlib.h>

#include <cstring>
#include <vector>

namespace mane {
namespace {

constexpr std::size_t kAlignment = 8; // a browser's typed arrays begin at multiples of their size

void append(Bytes& bytes, const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}
void align(Bytes& bytes) {
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment);
}

/// Small numbers of either sign become small numbers: 0, −1, 1, −2, …
std::uint32_t zigzag(std::int32_t x) {
    return (static_cast<std::uint32_t>(x) << 1) ^ static_cast<std::uint32_t>(x >> 31);
}

} // namespace

nlohmann::ordered_json& PagePayload::begin(std::string_view name, const char* type,
                                           std::size_t count) {
    align(data_);
    arrays_.push_back({{"name", name}, {"type", type}, {"count", count}, {"offset", data_.size()}});
    return arrays_.back();
}

template <typename T>
void PagePayload::add_numbers(std::string_view name, const char* type, std::span<const T> values) {
    begin(name, type, values.size());
    append(data_, values.data(), values.size_bytes());
}
void PagePayload::add(std::string_view name, std::span<const std::uint8_t> values) {
    add_numbers(name, "u8", values);
}
void PagePayload::add(std::string_view name, std::span<const std::uint16_t> values) {
    add_numbers(name, "u16", values);
}
void PagePayload::add(std::string_view name, std::span<const std::uint32_t> values) {
    add_numbers(name, "u32", values);
}
void PagePayload::add(std::string_view name, std::span<const float> values) {
    add_numbers(name, "f32", values);
}
void PagePayload::add(std::string_view name, std::span<const double> values) {
    add_numbers(name, "f64", values);
}

void PagePayload::append_planes(nlohmann::ordered_json& entry,
                                std::span<const std::uint32_t> values) {
    std::uint32_t used = 0;
    for (const std::uint32_t v : values)
        used |= v;
    int planes = 0;
    for (; used != 0; used >>= 8, ++planes)
        for (const std::uint32_t v : values)
            data_.push_back(static_cast<std::byte>(v >> (8 * planes)));
    entry["planes"] = planes;
}

void PagePayload::add_planes(std::string_view name, std::span<const std::uint32_t> values) {
    append_planes(begin(name, "planes", values.size()), values);
}

void PagePayload::add_steps(std::string_view name, double quantum, std::size_t row,
                            std::span<const std::int32_t> values) {
    // In whole numbers modulo 2³²: whatever overflows comes back when it is undone.
    std::vector<std::uint32_t> differences(values.size());
    const auto at = [&](std::size_t i, std::size_t rows_before) -> std::uint32_t {
        return i < rows_before * row ? 0
                                     : static_cast<std::uint32_t>(values[i - rows_before * row]);
    };
    for (std::size_t i = 0; i < values.size(); ++i)
        differences[i] = zigzag(static_cast<std::int32_t>(at(i, 0) - 2 * at(i, 1) + at(i, 2)));
    nlohmann::ordered_json& entry = begin(name, "steps", values.size());
    entry["quantum"] = quantum;
    entry["row"] = row;
    append_planes(entry, differences);
}

std::string PagePayload::packed() const {
    nlohmann::ordered_json header = header_;
    header["arrays"] = arrays_;
    const std::string json = header.dump();
    Bytes whole;
    const auto size = static_cast<std::uint32_t>(json.size());
    append(whole, kMagic, sizeof kMagic);
    append(whole, &kVersion, sizeof kVersion);
    append(whole, &size, sizeof size);
    append(whole, json.data(), json.size());
    align(whole);
    append(whole, data_.data(), data_.size());

    return deflated({reinterpret_cast<const char*>(whole.data()), whole.size()});
}

std::string deflated(std::string_view bytes) {
    uLongf length = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(length, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &length,
                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                  Z_DEFAULT_COMPRESSION) != Z_OK)
        throw InputError("the page's data is too large to be packed");
    packed.resize(length);
    return packed;
}

std::string base64(std::string_view bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group =
                group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

} // namespace mane
