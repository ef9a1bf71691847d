#include "mane/page.h"

#include "base/whole_file.h"
#include "formats/page_contacts.h"
#include "formats/page_payload.h"
#include "mane/cache.h"
#include "mane/error.h"
#include "mane/fields.h"
#include "mane/scene.h"
#include "mane/world.h"

#include <cmath>

namespace mane {
namespace {

constexpr double kQuantum = 1e-6;     // [m] positions and radii; well under a strand's width
constexpr double kAxisQuantum = 1e-5; // [1]
constexpr double kFarthest = 2000;    // [m] what fits in 32 bits of quanta

std::int32_t in_quanta(double x, double quantum, const char* what, std::size_t frame) {
    if (!(std::abs(x) <= kFarthest * quantum / kQuantum))
        throw InputError("frame " + std::to_string(frame) + " has a " + what +
                         " that is not finite or too far away for a page");
    return static_cast<std::int32_t>(std::lround(x / quantum));
}

nlohmann::ordered_json describe_strands(const SceneDesc& scene) {
    const StrandDesc& desc = scene.hair.strands;
    const Value distribution = find_field("strands", "distribution")->get(scene);
    return {{"count", desc.count},       {"distribution", std::get<std::string>(distribution)},
            {"jitter", desc.jitter},     {"lengthJitter", desc.length_jitter},
            {"waves", desc.waves},       {"waveAmplitude", desc.wave_amplitude},
            {"curls", desc.curls},       {"rootWidth", desc.root_width},
            {"tipWidth", desc.tip_width}};
}

void add_groom(const Groom& groom, PagePayload& payload) {
    payload.add("first_section", groom.first_section);
    payload.add("strands", groom.strands);
    std::vector<float> designed(groom.section_count());
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        for (std::size_t s = groom.first_section[w]; s + 1 < groom.first_section[w + 1]; ++s)
            designed[s] = length(groom.position[s + 1] - groom.position[s]);
    payload.add("designed_length", designed);
    payload.add("designed_radius", groom.radius);
    payload.add("rest_length", groom.rest_length);
}

void add_body(const Body& body, std::size_t index, PagePayload& payload) {
    const std::string prefix = "body" + std::to_string(index) + ".";
    payload.header()["bodies"].push_back(
        {{"name", body.name}, {"headBone", body.head_bone}, {"worn", body.worn}});
    const auto flat = [&]<typename T, typename R>(const char* name, const std::vector<R>& records) {
        payload.add(prefix + name, std::span(reinterpret_cast<const T*>(records.data()),
                                             records.size() * (sizeof(R) / sizeof(T))));
    };
    flat.operator()<float>("vertices", body.mesh.vertices);
    flat.operator()<std::uint32_t>("triangles", body.mesh.triangles);
    flat.operator()<std::uint16_t>("bones", body.skin.bones);
    flat.operator()<float>("weights", body.skin.weights);
}

/// All frames as rows of whole numbers.
void add_frames(const CacheReader& run, PagePayload& payload) {
    const Groom& groom = run.setup().groom;
    const std::size_t bodies = run.setup().bodies.size();
    std::vector<double> time, origin;
    std::vector<std::int32_t> position, radius, axis;
    std::vector<std::vector<double>> bone_position(bodies), bone_rotation(bodies);
    for (std::size_t i = 0; i < run.frame_count(); ++i) {
        const Frame frame = run.frame(i);
        time.push_back(frame.time);
        for (const double x : {frame.origin.x, frame.origin.y, frame.origin.z})
            origin.push_back(x);
        for (const Vec3& relative : frame.position) {
            const Vec3d p = Vec3d(relative) + frame.origin; // no jumps when the origin moves
            for (const double x : {p.x, p.y, p.z})
                position.push_back(in_quanta(x, kQuantum, "position", i));
        }
        for (const float r : frame.radius)
            radius.push_back(in_quanta(double{r}, kQuantum, "radius", i));
        for (const Vec3& a : frame.first_axis)
            for (const float x : {a.x, a.y, a.z})
                axis.push_back(in_quanta(double{x}, kAxisQuantum, "first axis", i));
        const BodyPoses poses = run.poses(i);
        for (std::size_t b = 0; b < bodies; ++b)
            for (const BonePose& bone : poses[b]) {
                const Vec3d& p = bone.position;
                const Quatd& q = bone.rotation;
                bone_position[b].insert(bone_position[b].end(), {p.x, p.y, p.z});
                bone_rotation[b].insert(bone_rotation[b].end(), {q.x, q.y, q.z, q.w});
            }
    }
    payload.add("time", time);
    payload.add("origin", origin);
    payload.add_steps("position", kQuantum, 3 * groom.section_count(), position);
    payload.add_steps("radius", kQuantum, groom.radius.size(), radius);
    payload.add_steps("first_axis", kAxisQuantum, 3 * groom.wisp_count(), axis);
    for (std::size_t b = 0; b < bodies; ++b) {
        payload.add("body" + std::to_string(b) + ".bone_position", bone_position[b]);
        payload.add("body" + std::to_string(b) + ".bone_rotation", bone_rotation[b]);
    }
}

void add_series(const std::vector<FrameSeries>& series, const char* of, std::size_t length,
                PagePayload& payload) {
    nlohmann::ordered_json& list = payload.header()[of] = nlohmann::ordered_json::array();
    for (const FrameSeries& s : series) {
        if (s.values.size() != length)
            throw InputError("series \"" + s.name + "\" has " + std::to_string(s.values.size()) +
                             " values, expected " + std::to_string(length));
        list.push_back({{"name", s.name}, {"unit", s.unit}});
        payload.add(std::string(of) + "." + s.name, s.values);
    }
}

} // namespace

std::string page_data(const CacheReader& run, const PageDesc& desc) {
    if (run.frame_count() == 0)
        throw InputError("the cache holds no frames");
    const Groom& groom = run.setup().groom;
    const SceneDesc scene = parse_scene(run.setup().scene, "scene in the cache", {});
    PagePayload payload;
    payload.header() = {{"title", desc.title},
                        {"frames", run.frame_count()},
                        {"frameRate", scene.simulation.schedule.frame_rate},
                        {"wisps", groom.wisp_count()},
                        {"envelopePoints", groom.envelope_points},
                        {"seed", scene.simulation.seed},
                        {"strandDesc", describe_strands(scene)},
                        {"bodies", nlohmann::ordered_json::array()}};
    add_groom(groom, payload);
    for (std::size_t b = 0; b < run.setup().bodies.size(); ++b)
        add_body(run.setup().bodies[b], b, payload);
    add_frames(run, payload);
    add_series(desc.head, "head", run.frame_count(), payload);
    add_series(desc.wisps, "wispSeries", run.frame_count() * groom.wisp_count(), payload);
    add_contacts(run, payload);
    return payload.packed();
}

void write_page(const CacheReader& run, const PageDesc& desc, std::string_view page,
                const std::filesystem::path& output) {
    constexpr std::string_view kPlace = "<!-- data -->";
    const std::size_t place = page.find(kPlace);
    if (place == std::string_view::npos)
        throw InputError("the page has no place for data");
    const std::string data = base64(page_data(run, desc));
    WholeFile file(output);
    file.write(page.substr(0, place));
    file.write("<script type=\"application/octet-stream\" id=\"run\">");
    file.write(data);
    file.write("</script>");
    file.write(page.substr(place + kPlace.size()));
    file.finish();
}

} // namespace mane
