#include "mane/cache.h"

#include "formats/cache_content.h"
#include "formats/chunk.h"
#include "mane/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace mane {

struct CacheWriter::Data {
    std::filesystem::path file, path;
    std::FILE* out = nullptr;
    std::uint64_t offset = 0;
    std::vector<ChunkInfo> chunks;
    std::size_t frames = 0, wisps = 0, sections = 0, points = 0, bodies = 0;

    explicit Data(std::filesystem::path target) : file(std::move(target)), path(file) {
        std::error_code error;
        const bool special =
            std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error);
        if (!special)
            path += ".part";
        out = std::fopen(path.string().c_str(), "wb");
        if (!out)
            fail();
    }
    ~Data() {
        if (!out)
            return;
        std::fclose(out);
        std::error_code error;
        if (frames == 0 && path != file)
            std::filesystem::remove(path, error);
    }

    [[noreturn]] void fail() const {
        const std::string reason = std::strerror(errno);
        std::string kept;
        if (frames > 0 && path != file)
            kept = "; " + std::to_string(frames) + " frames are in " + path.string();
        throw InputError(file.string() + ": cannot be written: " + reason + kept);
    }

    void write(const void* bytes, std::size_t size) {
        if (std::fwrite(bytes, 1, size, out) != size)
            fail();
        offset += size;
    }

    /// Flushed chunk by chunk: what a killed run leaves are whole chunks, and a full disk is found
    /// at once.
    void write_chunk(std::string_view type, std::uint32_t number, const Bytes& payload) {
        const PackedChunk chunk = pack_chunk(type, number, payload);
        const ChunkInfo info{std::string(type), number, offset, chunk.header.stored,
                             chunk.header.raw};
        write(&chunk.header, sizeof chunk.header);
        write(chunk.payload.data(), chunk.payload.size());
        if (std::fflush(out) != 0)
            fail();
        chunks.push_back(info);
    }

    void close() {
        std::FILE* closing = out;
        out = nullptr;
        if (std::fclose(closing) != 0)
            fail();
        if (path == file)
            return;
        std::error_code error;
        std::filesystem::rename(path, file, error);
        if (error)
            throw InputError(file.string() + ": cannot be written: " + error.message() +
                             "; the run is in " + path.string());
        path = file;
    }
};

CacheWriter::CacheWriter(std::filesystem::path file, const RunSetup& setup)
    : data_(std::make_unique<Data>(std::move(file))) {
    data_->wisps = setup.groom.wisp_count();
    data_->sections = setup.groom.section_count();
    data_->points = setup.groom.section_count() * setup.groom.envelope_points;
    data_->bodies = setup.bodies.size();
    const FileHeader header;
    data_->write(&header, sizeof header);
    data_->write_chunk("SCEN", 0, pack_text(setup.scene));
    data_->write_chunk("GROM", 0, pack_groom(setup.groom));
    for (std::size_t b = 0; b < setup.bodies.size(); ++b)
        data_->write_chunk("BODY", static_cast<std::uint32_t>(b), pack_body(setup.bodies[b]));
}

CacheWriter::~CacheWriter() = default;

void CacheWriter::add(const Frame& frame, const BodyPoses& poses) {
    if (frame.first_axis.size() != data_->wisps || frame.position.size() != data_->sections ||
        frame.velocity.size() != data_->sections || frame.radius.size() != data_->points ||
        frame.radius_rate.size() != data_->points || poses.size() != data_->bodies)
        throw InputError(data_->file.string() + ": frame " + std::to_string(frame.index) +
                         " does not fit the cache's groom and bodies");
    data_->write_chunk("FRAM", frame.index, pack_frame(frame, poses));
    ++data_->frames;
}

void CacheWriter::add_table(std::string_view type, std::uint32_t number,
                            std::span<const Column> table) {
    data_->write_chunk(type, number, pack_table(table));
}

void CacheWriter::finish(std::string_view statistics) {
    if (!statistics.empty())
        data_->write_chunk("STAT", 0, pack_text(statistics));
    FileTrailer trailer;
    trailer.index_offset = data_->offset;
    data_->write_chunk("INDX", 0, pack_index(data_->chunks));
    data_->write(&trailer, sizeof trailer);
    data_->close();
}

std::size_t CacheWriter::frame_count() const {
    return data_->frames;
}
const std::filesystem::path& CacheWriter::path() const {
    return data_->path;
}

} // namespace mane
