// The session as JavaScript calls it: plain functions, texts and numbers in the module's memory. A
// function that may fail gives false and keeps what was thrown for `solver_error`.

#include "session.h"

#include "mane/error.h"

#include <nlohmann/json.hpp>

#include <cinttypes>
#include <map>
#include <optional>
#include <span>

namespace mane::page {
namespace {

using Json = nlohmann::ordered_json;

std::optional<Session> session;
std::string error, text; ///< until the next call that makes one

/// Numbers in memory, of whatever type.
struct Numbers {
    const void* data = nullptr;
    std::size_t count = 0;
};
Numbers found;

template <typename Work> bool attempt(Work&& work) {
    try {
        work();
        return true;
    } catch (const std::exception& problem) {
        error = problem.what();
        return false;
    }
}

const char* give(std::string made) {
    text = std::move(made);
    return text.c_str();
}

Json describe(const StrandDesc& desc) {
    return {{"count", desc.count},
            {"distribution",
             std::get<std::string>(find_field("strands", "distribution")->get(session->scene()))},
            {"jitter", desc.jitter},
            {"lengthJitter", desc.length_jitter},
            {"waves", desc.waves},
            {"waveAmplitude", desc.wave_amplitude},
            {"curls", desc.curls},
            {"rootWidth", desc.root_width},
            {"tipWidth", desc.tip_width}};
}

std::size_t bone_count(const Body& body) {
    return body.motion ? body.motion->bone_count() : 0;
}

/// What is not an array.
Json describe_world() {
    const SceneDesc& scene = session->scene();
    const RunSetup& setup = session->setup();
    const World& world = session->world();
    Json bodies = Json::array();
    for (std::size_t b = 0; b < world.body_count(); ++b)
        bodies.push_back({{"name", world.body(b).name},
                          {"headBone", world.body(b).head_bone},
                          {"bones", bone_count(world.body(b))}});
    return {{"number", session->worlds()},
            {"name", session->name()},
            {"frameRate", scene.simulation.schedule.frame_rate},
            {"clip", scene.motion.clip},
            {"instructionSet", world.instruction_set()},
            {"warnings", setup.warnings},
            {"hair",
             {{"wisps", setup.groom.wisp_count()},
              {"envelopePoints", setup.groom.envelope_points},
              {"strandDesc", describe(scene.hair.strands)},
              {"seed", scene.simulation.seed}}},
            {"bodies", bodies}};
}

std::vector<float> designed_lengths(const Groom& groom) {
    std::vector<float> lengths(groom.section_count(), 0);
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        for (std::size_t s = groom.first_section[w]; s + 1 < groom.first_section[w + 1]; ++s)
            lengths[s] = length(groom.position[s + 1] - groom.position[s]);
    return lengths;
}

/// Time, origin, and the bones of all bodies: position, rotation.
std::vector<double> frame_doubles() {
    const World& world = session->world();
    const Frame& frame = world.frame();
    std::vector<double> numbers{frame.time, frame.origin.x, frame.origin.y, frame.origin.z};
    std::vector<BonePose> bones;
    for (std::size_t b = 0; b < world.body_count(); ++b) {
        const Motion* motion = world.body(b).motion.get();
        bones.resize(bone_count(world.body(b)));
        if (motion)
            motion->evaluate(frame.time, bones);
        for (const BonePose& bone : bones)
            for (const double x : {bone.position.x, bone.position.y, bone.position.z})
                numbers.push_back(x);
        for (const BonePose& bone : bones)
            for (const double x :
                 {bone.rotation.x, bone.rotation.y, bone.rotation.z, bone.rotation.w})
                numbers.push_back(x);
    }
    return numbers;
}

template <typename T> Numbers numbers(const std::vector<T>& list) {
    return {list.data(), list.size()};
}
/// Of small structs of numbers: `each` numbers in one.
template <typename T> Numbers numbers(const std::vector<T>& list, std::size_t each) {
    return {list.data(), list.size() * each};
}
/// Of what is made anew.
template <typename T> Numbers keep(std::vector<T> made) {
    static std::vector<T> kept;
    kept = std::move(made);
    return numbers(kept);
}

Numbers find(const std::string& name, std::size_t index) {
    const Frame& frame = session->world().frame();
    const Groom& groom = session->world().groom();
    const auto body = [&]() -> const Body& { return session->setup().bodies.at(index); };
    const std::map<std::string, std::function<Numbers()>> all{
        {"frame.doubles", [&] { return keep(frame_doubles()); }},
        {"frame.position", [&] { return numbers(frame.position, 3); }},
        {"frame.radius", [&] { return numbers(frame.radius); }},
        {"frame.first_axis", [&] { return numbers(frame.first_axis, 3); }},
        {"groom.first_section", [&] { return numbers(groom.first_section); }},
        {"groom.strands", [&] { return numbers(groom.strands); }},
        {"groom.designed_length", [&] { return keep(designed_lengths(groom)); }},
        {"body.vertices", [&] { return numbers(body().mesh.vertices, 3); }},
        {"body.triangles", [&] { return numbers(body().mesh.triangles, 3); }},
        {"body.bones", [&] { return numbers(body().skin.bones, Skin::kInfluences); }},
        {"body.weights", [&] { return numbers(body().skin.weights, Skin::kInfluences); }},
        {"statistics.stage_seconds", [&] {
             const auto& seconds = session->world().statistics().stage_seconds;
             return Numbers{seconds, std::size(seconds)};
         }}};
    const auto place = all.find(name);
    if (place == all.end())
        throw InputError("no numbers are called " + name);
    return place->second();
}

} // namespace
} // namespace mane::page

using namespace mane;
using namespace mane::page;

extern "C" {

bool solver_begin(unsigned threads) {
    return attempt([&] { session.emplace(threads); });
}
bool solver_open(const char* scene, const char* name) {
    return attempt([&] { session->open(scene, name); });
}
bool solver_set(const char* lines) {
    return attempt([&] { session->set(lines); });
}
bool solver_set_rates(const char* preset) {
    return attempt([&] { session->set_rates(preset); });
}
bool solver_take_clip(const char* file) {
    return attempt([&] { session->take_clip(file); });
}
bool solver_restart() {
    return attempt([&] { session->restart(); });
}
bool solver_advance() {
    return attempt([&] { session->advance(); });
}
bool solver_hold(double x, double y, double z, double yaw, double pitch, double roll) {
    return attempt([&] { session->hold({{x, y, z}, {yaw, pitch, roll}}); });
}
bool solver_pin(unsigned section, double x, double y, double z) {
    return attempt([&] { session->pin(section, {x, y, z}); });
}
bool solver_release(unsigned section) {
    return attempt([&] { session->release(section); });
}
bool solver_release_all() {
    return attempt([&] { session->release_all(); });
}
bool solver_teleport(double x, double y, double z) {
    return attempt([&] { session->teleport({x, y, z}); });
}

const char* solver_error() {
    return error.c_str();
}
/// All fields of scene files, as JSON schema.
const char* solver_schema() {
    return give(scene_schema());
}
const char* solver_stages() {
    Json names = Json::array();
    for (int s = 0; s < static_cast<int>(Stage::count); ++s)
        names.push_back(stage_name(static_cast<Stage>(s)));
    return give(names.dump());
}
const char* solver_world() {
    return give(describe_world().dump());
}
/// All fields' values as a scene file writes them, by key.
const char* solver_values() {
    Json values;
    for (const Field& f : fields_of<SceneDesc>())
        values[f.key()] = to_toml(f.get(session->scene()));
    return give(values.dump());
}
const char* solver_scene() {
    return give(write_scene(session->scene()));
}
const char* solver_hash() {
    char hex[17];
    std::snprintf(hex, sizeof hex, "%016" PRIx64, session->world().state_hash());
    return give(hex);
}

/// Looks for numbers by name: `solver_found`, `solver_found_count`.
bool solver_find(const char* name, unsigned index) {
    return attempt([&] { found = find(name, index); });
}
const void* solver_found() {
    return found.data;
}
std::size_t solver_found_count() {
    return found.count;
}
unsigned solver_worlds() {
    return session->worlds();
}
unsigned solver_frame_index() {
    return session->world().frame().index;
}
}
