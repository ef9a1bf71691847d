#include "formats/chunk.h"

#include "mane/error.h"

#include <xxhash.h>
#include <zstd.h>

#include <cstddef>

namespace mane {
namespace {

constexpr int kLevel = 1; // measured on frames: higher levels gain 2 % and cost tenfold

std::uint64_t header_check(const ChunkHeader& header) {
    return XXH3_64bits(&header, offsetof(ChunkHeader, header_check));
}

ChunkInfo describe(const ChunkHeader& header, std::uint64_t offset) {
    return {
        {header.type.data(), header.type.size()}, header.number, offset, header.stored, header.raw};
}

} // namespace

PackedChunk pack_chunk(std::string_view type, std::uint32_t number, const Bytes& payload) {
    PackedChunk chunk;
    chunk.payload.resize(ZSTD_compressBound(payload.size()));
    const std::size_t stored = ZSTD_compress(chunk.payload.data(), chunk.payload.size(),
                                             payload.data(), payload.size(), kLevel);
    if (ZSTD_isError(stored))
        throw InputError(std::string("zstd: ") + ZSTD_getErrorName(stored));
    chunk.payload.resize(stored);
    for (std::size_t i = 0; i < chunk.header.type.size(); ++i)
        chunk.header.type[i] = type.at(i);
    chunk.header.number = number;
    chunk.header.stored = stored;
    chunk.header.raw = payload.size();
    chunk.header.payload_check = XXH3_64bits(chunk.payload.data(), stored);
    chunk.header.header_check = header_check(chunk.header);
    return chunk;
}

ChunkFile::ChunkFile(const std::filesystem::path& file)
    : name_(file.string()), in_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (!in_ || error)
        throw InputError(name_ + ": cannot be read");
    FileHeader header;
    const FileHeader expected;
    if (!read_at(0, header) || header.magic != expected.magic)
        throw InputError(name_ + ": is no .mane file (bad magic)");
    if (header.version != expected.version || header.reserved != 0)
        throw InputError(name_ + ": has format version " + std::to_string(header.version) +
                         ", expected " + std::to_string(expected.version));
    version_ = header.version;
    if (!read_index())
        walk();
}

template <typename T> bool ChunkFile::read_at(std::uint64_t offset, T& out) {
    if (offset > size_ || sizeof(T) > size_ - offset)
        return false;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(offset));
    in_.read(reinterpret_cast<char*>(&out), sizeof(T));
    return static_cast<bool>(in_);
}

/// A header that is whole, whose payload lies inside the file.
bool ChunkFile::read_header(std::uint64_t offset, ChunkHeader& header) {
    return read_at(offset, header) && header.header_check == header_check(header) &&
           header.stored <= size_ - offset - sizeof header;
}

bool ChunkFile::read_index() {
    FileTrailer trailer;
    const FileTrailer expected;
    if (size_ < sizeof trailer || !read_at(size_ - sizeof trailer, trailer) ||
        trailer.magic != expected.magic) {
        damage_ = "no index: the run was interrupted";
        return false;
    }
    try {
        ChunkHeader header;
        if (!read_header(trailer.index_offset, header))
            throw InputError(name_ + ": the index is not where the trailer says");
        const ArrayReader index = arrays(describe(header, trailer.index_offset));
        const auto types = index.get<std::array<char, 4>>("type");
        const auto numbers = index.get<std::uint32_t>("number");
        const auto offsets = index.get<std::uint64_t>("offset"),
                   stored = index.get<std::uint64_t>("stored"),
                   raw = index.get<std::uint64_t>("raw");
        if (numbers.size() != types.size() || offsets.size() != types.size() ||
            stored.size() != types.size() || raw.size() != types.size())
            index.fail("its columns are not equally long");
        for (std::size_t i = 0; i < types.size(); ++i)
            chunks_.push_back({{types[i].data(), 4}, numbers[i], offsets[i], stored[i], raw[i]});
        return true;
    } catch (const InputError& error) {
        damage_ = error.what();
        return false;
    }
}

void ChunkFile::walk() {
    ChunkHeader header;
    std::uint64_t offset = sizeof(FileHeader);
    while (offset < size_ && read_header(offset, header)) {
        const ChunkInfo chunk = describe(header, offset);
        if (chunk.type == "INDX")
            return; // the trailer behind it is what is damaged
        chunks_.push_back(chunk);
        offset += sizeof header + header.stored;
    }
    if (offset < size_)
        damage_ += "; no whole chunk at byte " + std::to_string(offset);
}

std::string ChunkFile::place(const ChunkInfo& chunk) const {
    return name_ + ": chunk " + chunk.type + " " + std::to_string(chunk.number) + " at byte " +
           std::to_string(chunk.offset);
}

Bytes ChunkFile::payload(const ChunkInfo& chunk) {
    ChunkHeader header;
    if (!read_header(chunk.offset, header))
        throw InputError(place(chunk) + ": its header is damaged");
    Bytes stored(header.stored);
    in_.read(reinterpret_cast<char*>(stored.data()), static_cast<std::streamsize>(stored.size()));
    if (!in_)
        throw InputError(place(chunk) + ": cannot be read");
    if (header.payload_check != XXH3_64bits(stored.data(), stored.size()))
        throw InputError(place(chunk) + ": checksum mismatch");
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != header.raw)
        throw InputError(place(chunk) + ": its size does not hold");
    Bytes raw(header.raw);
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) || size != raw.size())
        throw InputError(place(chunk) + ": cannot be unpacked");
    return raw;
}

ArrayReader ChunkFile::arrays(const ChunkInfo& chunk) {
    return {payload(chunk), place(chunk)};
}

Bytes pack_index(const std::vector<ChunkInfo>& chunks) {
    std::vector<std::array<char, 4>> types;
    std::vector<std::uint32_t> numbers;
    std::vector<std::uint64_t> offsets, stored, raw;
    for (const ChunkInfo& c : chunks) {
        types.push_back({c.type[0], c.type[1], c.type[2], c.type[3]});
        numbers.push_back(c.number);
        offsets.push_back(c.offset);
        stored.push_back(c.stored);
        raw.push_back(c.raw);
    }
    ArrayWriter index;
    index.add("type", "", types);
    index.add("number", "", numbers);
    index.add("offset", "byte", offsets);
    index.add("stored", "byte", stored);
    index.add("raw", "byte", raw);
    return index.payload();
}

} // namespace mane
