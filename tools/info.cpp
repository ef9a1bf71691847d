#include "commands.h"

#include "mane/cache.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace mane::tool {
namespace {

using Json = nlohmann::ordered_json;

Json describe_hair(const Groom& groom) {
    std::uint64_t strands = 0;
    for (const std::uint32_t s : groom.strands)
        strands += s;
    const double wisps = static_cast<double>(groom.wisp_count());
    return {{"wisps", groom.wisp_count()},
            {"sections", groom.section_count()},
            {"segments_per_wisp",
             wisps > 0 ? static_cast<double>(groom.section_count()) / wisps - 2 : 0},
            {"envelope_points", groom.envelope_points},
            {"strands", strands}};
}

Json describe_bodies(const std::vector<Body>& bodies, const BodyPoses& poses) {
    Json list = Json::array();
    for (std::size_t b = 0; b < bodies.size(); ++b)
        list.push_back({{"name", bodies[b].name},
                        {"vertices", bodies[b].mesh.vertices.size()},
                        {"triangles", bodies[b].mesh.triangles.size()},
                        {"bones", b < poses.size() ? poses[b].size() : 0},
                        {"worn", bodies[b].worn}});
    return list;
}

Json describe_chunks(const std::vector<ChunkInfo>& chunks) {
    Json types = Json::object();
    for (const ChunkInfo& c : chunks) {
        Json& type = types[c.type];
        if (type.is_null())
            type = {{"count", 0}, {"stored", 0}, {"raw", 0}};
        type["count"] = type["count"].get<std::uint64_t>() + 1;
        type["stored"] = type["stored"].get<std::uint64_t>() + c.stored;
        type["raw"] = type["raw"].get<std::uint64_t>() + c.raw;
    }
    return types;
}

Json describe(const CacheReader& cache, const std::string& file) {
    const std::size_t frames = cache.frame_count();
    Json all{{"file", file},
             {"format_version", cache.version()},
             {"bytes", std::filesystem::file_size(file)},
             {"whole", cache.damage().empty()},
             {"damage", cache.damage()},
             {"frames", frames}};
    if (frames > 0) {
        all["first_time"] = cache.frame(0).time;
        all["last_time"] = cache.frame(frames - 1).time;
    }
    all["hair"] = describe_hair(cache.setup().groom);
    all["bodies"] =
        describe_bodies(cache.setup().bodies, frames > 0 ? cache.poses(0) : BodyPoses());
    all["chunks"] = describe_chunks(cache.chunks());
    const std::string statistics = cache.statistics();
    all["statistics"] = statistics.empty() ? Json() : Json::parse(statistics);
    all["scene"] = cache.setup().scene;
    return all;
}

void print(const Json& all) {
    fmt::print("{}  {:.2f} MB, format {}\n", all["file"].get<std::string>(),
               all["bytes"].get<double>() / 1e6, all["format_version"].get<int>());
    if (!all["whole"])
        fmt::print("  not whole: {}\n", all["damage"].get<std::string>());
    fmt::print("  {} frames", all["frames"].get<std::size_t>());
    if (all.contains("first_time"))
        fmt::print(", {:.3f} s to {:.3f} s", all["first_time"].get<double>(),
                   all["last_time"].get<double>());
    const Json& hair = all["hair"];
    fmt::print("\n  {} wisps of {:.1f} segments, {} envelope points per section, {} strands\n",
               hair["wisps"].get<int>(), hair["segments_per_wisp"].get<double>(),
               hair["envelope_points"].get<int>(), hair["strands"].get<std::uint64_t>());
    for (const Json& body : all["bodies"])
        fmt::print("  {}: {} vertices, {} triangles, {} bones{}\n", body["name"].get<std::string>(),
                   body["vertices"].get<int>(), body["triangles"].get<int>(),
                   body["bones"].get<int>(), body["worn"] ? ", worn" : "");
    fmt::print("\n  chunk   count     stored        raw  ratio\n");
    for (const auto& [type, c] : all["chunks"].items()) {
        const double stored = c["stored"].get<double>(), raw = c["raw"].get<double>();
        fmt::print("  {:5} {:7} {:7.2f} MB {:7.2f} MB {:6.2f}\n", type, c["count"].get<int>(),
                   stored / 1e6, raw / 1e6, stored > 0 ? raw / stored : 1);
    }
    if (all["statistics"].contains("state_hash"))
        fmt::print("\n  state hash {}\n", all["statistics"]["state_hash"].get<std::string>());
}

} // namespace

int info(const InfoOptions& options) {
    const CacheReader cache(options.file);
    cache.verify();
    const Json all = describe(cache, options.file);
    if (options.json)
        fmt::print("{}\n", all.dump(2));
    else
        print(all);
    return 0;
}

} // namespace mane::tool
