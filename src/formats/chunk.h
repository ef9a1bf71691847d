#pragma once

#include "formats/arrays.h"
#include "mane/cache.h"

#include <array>
#include <fstream>

namespace mane {

/// The first bytes of a file. Not text, and broken by every transfer that takes it for text.
struct FileHeader {
    std::array<char, 8> magic{'\x89', 'M', 'A', 'N', 'E', '\r', '\n', '\x1a'};
    std::uint32_t version = kVersion;
    std::uint32_t reserved = 0;
    static constexpr std::uint32_t kVersion = 1;
};
static_assert(sizeof(FileHeader) == 16);

/// The last bytes of a finished file.
struct FileTrailer {
    std::uint64_t index_offset = 0;
    std::array<char, 8> magic{'M', 'A', 'N', 'E', '-', 'E', 'N', 'D'};
};
static_assert(sizeof(FileTrailer) == 16);

struct ChunkHeader {
    std::array<char, 4> type{};
    std::uint32_t number = 0;
    std::uint64_t stored = 0;        ///< [byte] that follow
    std::uint64_t raw = 0;           ///< [byte] when unpacked
    std::uint64_t payload_check = 0; ///< XXH3 of the stored payload
    std::uint64_t header_check =
        0; ///< XXH3 of the fields above: a walk over the headers needs no payload
};
static_assert(sizeof(ChunkHeader) == 40);

/// Compresses a payload and makes its header.
struct PackedChunk {
    ChunkHeader header;
    Bytes payload;
};
PackedChunk pack_chunk(std::string_view type, std::uint32_t number, const Bytes& payload);

/// A file that chunks are read from.
class ChunkFile {
  public:
    /// Throws InputError when it cannot be read or does not begin with our header.
    explicit ChunkFile(const std::filesystem::path& file);

    std::uint32_t version() const { return version_; }
    /// The chunks of the index where there is one, else those found from the beginning on.
    const std::vector<ChunkInfo>& chunks() const { return chunks_; }
    const std::string& damage() const { return damage_; }
    /// The unpacked payload. Throws InputError when a checksum or a size does not hold.
    Bytes payload(const ChunkInfo& chunk);
    ArrayReader arrays(const ChunkInfo& chunk);
    std::string place(const ChunkInfo& chunk) const;

  private:
    template <typename T> bool read_at(std::uint64_t offset, T& out);
    bool read_header(std::uint64_t offset, ChunkHeader& header);
    bool read_index();
    void walk();

    std::string name_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    std::uint32_t version_ = 0;
    std::vector<ChunkInfo> chunks_;
    std::string damage_;
};

/// The list of chunks as the index stores it.
Bytes pack_index(const std::vector<ChunkInfo>& chunks);

} // namespace mane
