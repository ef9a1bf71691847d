#include "mane/live_scene.h"

#include "mane/error.h"

#include <algorithm>
#include <string>

namespace mane {
namespace {

void refuse_fixed(const std::string& what, const std::string& found, const std::string& expected) {
    throw InputError(what + ": found " + found + ", expected " + expected +
                     ": it is fixed while a world runs");
}

bool same(const ObstacleDesc& a, const ObstacleDesc& b) {
    const auto same_fields = [](const auto& x, const auto& y) {
        const auto fields = fields_of<std::remove_cvref_t<decltype(x)>>();
        return std::all_of(fields.begin(), fields.end(),
                           [&](const auto& f) { return f.get(x) == f.get(y); });
    };
    return same_fields(a, b) &&
           std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(), same_fields);
}

bool same(const WispOverride& a, const WispOverride& b) {
    return a.wisps == b.wisps && a.settings == b.settings;
}

template <typename T> bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const T& x, const T& y) { return same(x, y); });
}

void check_fixed(const SceneDesc& now, const SceneDesc& next) {
    for (const Field& f : fields_of<SceneDesc>())
        if (!has(f.use, FieldUse::live) && f.get(next) != f.get(now))
            refuse_fixed(f.key(), to_toml(f.get(next)), to_toml(f.get(now)));
    if (!same(now.obstacles, next.obstacles))
        refuse_fixed("obstacle", "other ones", "those that there are");
}

/// Whether hair grows from a field, and not only on it.
bool makes_hair(const FieldInfo& field) {
    return field.section == "style" || field.section == "skeleton" || field.section == "envelope" ||
           field.key() == "strands.count";
}

bool same_hair(const SceneDesc& now, const SceneDesc& next) {
    for (const Field& f : fields_of<SceneDesc>())
        if (makes_hair(f) && f.get(now) != f.get(next))
            return false;
    return same(now.overrides, next.overrides);
}

} // namespace

LiveScene::LiveScene(const SceneDesc& scene, const Groom& groom, std::vector<Body> bodies,
                     Grow grow, double start_time, const RunOptions& options)
    : scene_(scene), world_(scene.simulation, groom, std::move(bodies), start_time, options),
      grow_(std::move(grow)) {}

void LiveScene::change(const SceneDesc& scene) {
    check_fixed(scene_, scene);
    check_scene(scene, "change");
    SceneDesc next = scene; // a copy before anything changes: only then can nothing fail
    if (same_hair(scene_, scene))
        world_.change(scene.simulation);
    else
        world_.change(scene.simulation, grow_(scene));
    std::swap(scene_, next);
}

} // namespace mane
