#pragma once

/// The `.mane` cache: a run on disk, for everything that draws or judges it without the solver.
///
/// A file is a header of 16 bytes (magic, version) and a sequence of typed chunks. A chunk is a
/// header (type of four letters, number, sizes, XXH3 checksums of itself and of its payload) and a
/// payload: named, typed arrays, byte by byte of equal rank, packed by zstd. The last chunk is an
/// index of all others, found by a trailer of 16 bytes; without it (a run that was killed) the
/// chunks are found by walking from header to header. Chunks of unknown types are skipped.
/// Little-endian, no loss.

#include "mane/body.h"
#include "mane/frame.h"
#include "mane/groom.h"
#include "mane/setup.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mane {

/// The bones of each body at one frame. Poses and the skin give every vertex; they are a hundred
/// times smaller than the vertices.
using BodyPoses = std::vector<std::vector<BonePose>>;

/// One named column of a table that is stored beside a frame, as `--record` does.
struct Column {
    std::string name;
    std::string unit;
    std::variant<std::vector<std::uint32_t>, std::vector<float>, std::vector<double>> values;
};

/// A chunk as the file lists it.
struct ChunkInfo {
    std::string type; ///< four letters: SCEN, GROM, BODY, FRAM, STAT, or one of a later version
    std::uint32_t number = 0; ///< of the frame or body
    std::uint64_t offset = 0; ///< [byte] of its header in the file
    std::uint64_t stored = 0; ///< [byte] packed payload
    std::uint64_t raw = 0;    ///< [byte] unpacked payload
};

/// Writes a cache frame by frame into `FILE.part` beside the file, which takes the file's name only
/// when it is finished: under its own name a cache is always whole. A killed run leaves
/// `FILE.part`, readable up to its last finished frame. A file that is no regular one (a device, a
/// pipe) is written directly.
class CacheWriter {
  public:
    /// Throws InputError when the file cannot be written.
    CacheWriter(std::filesystem::path file, const RunSetup& setup);
    /// Unfinished: keeps `FILE.part` if it holds a frame, else removes it.
    ~CacheWriter();
    CacheWriter(const CacheWriter&) = delete;
    CacheWriter& operator=(const CacheWriter&) = delete;

    /// Adds a frame; when it returns, the frame is in the hands of the system. Throws InputError
    /// when it cannot be written (full disk) or does not fit the setup.
    void add(const Frame& frame, const BodyPoses& poses);
    /// Adds a table to frame `number`, under a type of four letters.
    void add_table(std::string_view type, std::uint32_t number, std::span<const Column> table);
    /// Adds statistics (JSON) and the index, and gives the file its name. Throws InputError.
    void finish(std::string_view statistics = {});

    std::size_t frame_count() const;
    /// Where the frames are now: `FILE.part`, or the file itself once it is finished.
    const std::filesystem::path& path() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Reads a cache, finished or not; frames in any order. Not for several threads at once.
/// All members throw InputError for damage, naming the chunk and its place in the file.
class CacheReader {
  public:
    /// Throws InputError for a file that is none of ours, of another version, or that ends before
    /// its first frame could follow.
    explicit CacheReader(const std::filesystem::path& file);
    ~CacheReader();
    CacheReader(CacheReader&&) noexcept;
    CacheReader& operator=(CacheReader&&) noexcept;

    std::uint32_t version() const;
    const RunSetup& setup() const;
    std::size_t frame_count() const;
    Frame frame(std::size_t i) const;
    BodyPoses poses(std::size_t i) const;
    /// Vertices of a body at frame `i` [m], relative to that frame's origin.
    std::vector<Vec3> body_vertices(std::size_t i, std::size_t body) const;
    /// The table of this type that was stored with frame `number`; empty if there is none.
    std::vector<Column> table(std::string_view type, std::uint32_t number) const;
    /// Statistics as JSON; empty for a run that was killed.
    std::string statistics() const;

    /// Empty for a whole file; else why it is not: `no index: the run was interrupted`.
    const std::string& damage() const;
    const std::vector<ChunkInfo>& chunks() const;
    /// Reads every chunk, those of unknown types too. Throws InputError for the first damaged one.
    void verify() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Vertices of a body whose bones have these poses [m], relative to `origin`: linear blend
/// skinning, in double precision. Without bones: the rest pose. Throws InputError for a skin that
/// names a bone there is not.
std::vector<Vec3> skinned_vertices(const Body& body, std::span<const BonePose> bones,
                                   const Vec3d& origin);

} // namespace mane
