#include "mane/cache.h"

#include "formats/cache_content.h"
#include "formats/chunk.h"
#include "mane/error.h"

namespace mane {

struct CacheReader::Data {
    mutable ChunkFile file;
    std::string name;
    RunSetup setup;
    std::vector<ChunkInfo> frames;

    explicit Data(const std::filesystem::path& path) : file(path), name(path.string()) {
        setup.scene = unpack_text(file.arrays(the("SCEN")));
        setup.groom = unpack_groom(file.arrays(the("GROM")));
        for (const ChunkInfo& chunk : file.chunks()) {
            if (chunk.type == "BODY")
                setup.bodies.push_back(unpack_body(file.arrays(chunk)));
            if (chunk.type == "FRAM")
                frames.push_back(chunk);
        }
    }

    const ChunkInfo* find(std::string_view type, std::uint32_t number) const {
        for (const ChunkInfo& chunk : file.chunks())
            if (chunk.type == type && chunk.number == number)
                return &chunk;
        return nullptr;
    }
    const ChunkInfo& the(std::string_view type) const {
        if (const ChunkInfo* chunk = find(type, 0))
            return *chunk;
        throw InputError(name + ": is truncated: there is no whole chunk " + std::string(type) +
                         (file.damage().empty() ? "" : " (" + file.damage() + ")"));
    }
    ArrayReader frame(std::size_t i) const {
        if (i >= frames.size())
            throw InputError(name + ": has no frame " + std::to_string(i) +
                             ", expected one under " + std::to_string(frames.size()));
        return file.arrays(frames[i]);
    }
};

CacheReader::CacheReader(const std::filesystem::path& file) : data_(std::make_unique<Data>(file)) {}
CacheReader::~CacheReader() = default;
CacheReader::CacheReader(CacheReader&&) noexcept = default;
CacheReader& CacheReader::operator=(CacheReader&&) noexcept = default;

std::uint32_t CacheReader::version() const {
    return data_->file.version();
}
const RunSetup& CacheReader::setup() const {
    return data_->setup;
}
std::size_t CacheReader::frame_count() const {
    return data_->frames.size();
}
const std::string& CacheReader::damage() const {
    return data_->file.damage();
}
const std::vector<ChunkInfo>& CacheReader::chunks() const {
    return data_->file.chunks();
}

Frame CacheReader::frame(std::size_t i) const {
    return unpack_frame(data_->frame(i), data_->setup.groom);
}

BodyPoses CacheReader::poses(std::size_t i) const {
    return unpack_poses(data_->frame(i), data_->setup.bodies.size());
}

std::vector<Vec3> CacheReader::body_vertices(std::size_t i, std::size_t body) const {
    const ArrayReader chunk = data_->frame(i);
    const BodyPoses poses = unpack_poses(chunk, data_->setup.bodies.size());
    return skinned_vertices(data_->setup.bodies.at(body), poses.at(body),
                            chunk.get_value<Vec3d>("origin"));
}

std::vector<Column> CacheReader::table(std::string_view type, std::uint32_t number) const {
    const ChunkInfo* chunk = data_->find(type, number);
    return chunk ? unpack_table(data_->file.arrays(*chunk)) : std::vector<Column>();
}

std::string CacheReader::statistics() const {
    const ChunkInfo* chunk = data_->find("STAT", 0);
    return chunk ? unpack_text(data_->file.arrays(*chunk)) : std::string();
}

void CacheReader::verify() const {
    for (const ChunkInfo& chunk : data_->file.chunks())
        data_->file.payload(chunk);
}

std::vector<Vec3> skinned_vertices(const Body& body, std::span<const BonePose> bones,
                                   const Vec3d& origin) {
    std::vector<Vec3> vertices;
    vertices.reserve(body.mesh.vertices.size());
    const auto posed = [&](std::size_t bone, const Vec3d& rest) {
        if (bone >= bones.size())
            throw InputError(body.name + ": its skin names bone " + std::to_string(bone) +
                             ", it has " + std::to_string(bones.size()));
        return bones[bone].rotation.rotate(rest) + bones[bone].position;
    };
    for (std::size_t v = 0; v < body.mesh.vertices.size(); ++v) {
        const Vec3d rest(body.mesh.vertices[v]);
        Vec3d p;
        if (bones.empty())
            p = rest;
        else if (body.skin.bones.empty())
            p = posed(0, rest);
        else
            for (std::size_t k = 0; k < Skin::kInfluences; ++k) {
                const double weight = static_cast<double>(body.skin.weights[v][k]);
                if (weight != 0)
                    p += posed(body.skin.bones[v][k], rest) * weight;
            }
        vertices.emplace_back(p - origin);
    }
    return vertices;
}

} // namespace mane
