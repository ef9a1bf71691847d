#include "formats/arrays.h"

#include "mane/error.h"

namespace mane {
namespace {

// One transposition makes structure of arrays and shuffles bytes: byte b of all records stands
// together, so that signs and exponents of neighbours meet and zstd finds them alike.
void shuffle(std::span<const std::byte> records, std::size_t size, std::byte* out) {
    const std::size_t count = records.size() / size;
    for (std::size_t b = 0; b < size; ++b)
        for (std::size_t i = 0; i < count; ++i)
            *out++ = records[i * size + b];
}

void unshuffle(const std::byte* in, std::size_t size, std::span<std::byte> records) {
    const std::size_t count = records.size() / size;
    for (std::size_t b = 0; b < size; ++b)
        for (std::size_t i = 0; i < count; ++i)
            records[i * size + b] = *in++;
}

template <typename T> void append(Bytes& out, const T& value) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    out.insert(out.end(), bytes, bytes + sizeof value);
}

void append_text(Bytes& out, const std::string& text) {
    append(out, static_cast<std::uint8_t>(text.size()));
    for (const char c : text)
        out.push_back(static_cast<std::byte>(c));
}

/// Reads the directory, never past the end.
struct Cursor {
    const ArrayReader& reader;
    std::span<const std::byte> rest;

    std::span<const std::byte> take(std::size_t n) {
        if (n > rest.size())
            reader.fail("its directory ends too early");
        const auto taken = rest.first(n);
        rest = rest.subspan(n);
        return taken;
    }
    template <typename T> T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() {
        const auto bytes = take(number<std::uint8_t>());
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    ArrayInfo array() {
        ArrayInfo info;
        info.name = text();
        info.unit = text();
        info.element = Element{number<std::uint8_t>()};
        info.components = number<std::uint8_t>();
        info.count = number<std::uint64_t>();
        if (info.element > Element::f64 || info.components == 0)
            reader.fail("array \"" + info.name + "\" is of no known type");
        return info;
    }
};

} // namespace

void ArrayWriter::add_bytes(const ArrayInfo& info, std::span<const std::byte> records) {
    ++count_;
    append_text(directory_, info.name);
    append_text(directory_, info.unit);
    append(directory_, static_cast<std::uint8_t>(info.element));
    append(directory_, info.components);
    append(directory_, info.count);
    const std::size_t start = data_.size();
    data_.resize(start + records.size());
    shuffle(records, info.record_size(), data_.data() + start);
}

Bytes ArrayWriter::payload() const {
    Bytes out;
    out.reserve(sizeof count_ + directory_.size() + data_.size());
    append(out, count_);
    out.insert(out.end(), directory_.begin(), directory_.end());
    out.insert(out.end(), data_.begin(), data_.end());
    return out;
}

ArrayReader::ArrayReader(Bytes payload, std::string where)
    : payload_(std::move(payload)), where_(std::move(where)) {
    Cursor cursor{*this, payload_};
    const auto count = cursor.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i)
        arrays_.push_back(cursor.array());
    for (const ArrayInfo& info : arrays_) {
        offsets_.push_back(payload_.size() - cursor.rest.size());
        if (info.count > cursor.rest.size() / info.record_size())
            fail("array \"" + info.name + "\" is longer than the chunk");
        cursor.take(info.count * info.record_size());
    }
    if (!cursor.rest.empty())
        fail("bytes follow its last array");
}

bool ArrayReader::contains(std::string_view name) const {
    for (const ArrayInfo& info : arrays_)
        if (info.name == name)
            return true;
    return false;
}

std::size_t ArrayReader::find(std::string_view name, Element element,
                              std::uint8_t components) const {
    for (std::size_t i = 0; i < arrays_.size(); ++i)
        if (arrays_[i].name == name && arrays_[i].element == element &&
            arrays_[i].components == components)
            return i;
    fail("array \"" + std::string(name) + "\" is missing or of another type");
}

void ArrayReader::copy(std::size_t array, std::span<std::byte> records) const {
    unshuffle(payload_.data() + offsets_[array], arrays_[array].record_size(), records);
}

void ArrayReader::fail(const std::string& reason) const {
    throw InputError(where_ + ": " + reason);
}

} // namespace mane
