#include "session.h"

#include "mane/error.h"
#include "mane/import.h"

#include <algorithm>
#include <cmath>

namespace mane::page {
namespace {

/// Where relative names of files start: the page has a disk of its own.
constexpr const char* kFolder = "/";

/// Calls `apply(line)` for each line that says something.
template <typename Apply> void for_lines(const std::string& text, const Apply& apply) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end > begin)
            apply(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
    }
}

/// What a change of a field asks for.
enum class Effect : std::uint8_t {
    kept,   ///< of no meaning here; who copies the scene has it
    live,   ///< the world takes it as it runs
    motion, ///< the character's, which is led here
    anew,   ///< another world
};

Effect effect_of(const FieldInfo& field) {
    if (has(field.use, FieldUse::live))
        return Effect::live;
    if (field.section == "motion")
        return Effect::motion;
    const bool length = field.name == "frames" || field.name == "preroll";
    return field.section == "check" || length ? Effect::kept : Effect::anew;
}

bool differ(const SceneDesc& a, const SceneDesc& b, Effect effect) {
    for (const Field& f : fields_of<SceneDesc>())
        if (effect_of(f) == effect && f.get(a) != f.get(b))
            return true;
    return false;
}

/// `scene` with the live fields of `next`: as far as a running world goes along.
SceneDesc with_live_fields(SceneDesc scene, const SceneDesc& next) {
    for (const Field& f : fields_of<SceneDesc>())
        if (effect_of(f) == Effect::live)
            f.set(scene, f.get(next));
    return scene;
}

/// How long a motion is until it begins again [s]; 0: it does not.
double length_of(const MotionDesc& motion) {
    constexpr double kBuiltin = 12; // a second of rest included
    const bool builtin = !motion.still && motion.clip.empty() && motion.shake == 0;
    return builtin && motion.freeze == 0 ? kBuiltin : 0;
}

/// How high a clip's skeleton stands in its rest pose, in the clip's unit.
double standing_height(const Clip& clip) {
    std::vector<double> height;
    for (const Clip::Joint& joint : clip.joints)
        height.push_back(joint.offset.y +
                         (joint.parent < 0 ? 0 : height[static_cast<std::size_t>(joint.parent)]));
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    return *high - *low;
}

/// The usual unit [m] in which a skeleton is nearest to a person of 1.7 m: files do not say theirs.
/// 0.0564444 is the one of CMU's captures: inches, and 0.45 of them to the unit.
double likely_unit(const Clip& clip) {
    constexpr double kUnits[] = {1, 0.1, 0.0564444, 0.0254, 0.01, 0.001};
    const double height = standing_height(clip);
    const auto misfit = [&](double unit) { return std::abs(std::log(height * unit / 1.7)); };
    return *std::min_element(std::begin(kUnits), std::end(kUnits),
                             [&](double a, double b) { return misfit(a) < misfit(b); });
}

} // namespace

void Session::open(const std::string& text, const std::string& name) {
    build(parse_scene(text, name, kFolder));
    name_ = name;
}

void Session::set(const std::string& lines) {
    SceneDesc next = scene_;
    for_lines(lines, [&](std::string_view line) { apply_setting(next, line); });
    change_to(next);
}

void Session::set_rates(const std::string& preset) {
    SceneDesc next = scene_;
    apply_rates(next, preset);
    change_to(next);
}

void Session::take_clip(const std::string& file) {
    SceneDesc next = scene_;
    next.motion = {};
    next.motion.clip = file;
    next.motion.drive.unit = likely_unit(read_bvh(file));
    change_to(next);
}

void Session::restart() {
    if (write_scene(scene_) != setup_->scene)
        return build(scene_);
    lead_->begin(make_motion(scene_.motion), length_of(scene_.motion));
    begin(scene_, *setup_);
}

void Session::advance() {
    lead_->advance(world().frame().time, world().next_time());
    live_->world().advance();
}

void Session::teleport(const Vec3d& by) {
    lead_->jump(by, world().frame().time);
    live_->world().teleport();
}

void Session::pin(std::uint32_t section, const Vec3d& place) {
    Pin pin;
    pin.section = section;
    pin.place = place;
    pin.ease = 0.06; // a hand's places come many times a second
    live_->world().pin(pin);
}

void Session::release(std::uint32_t section) {
    live_->world().release(section);
}

void Session::release_all() {
    for (const Pin& pin : world().pins())
        live_->world().release(pin.section);
}

void Session::change_to(const SceneDesc& scene) {
    if (differ(scene_, scene, Effect::anew))
        return build(scene);
    const bool moves = differ(scene_, scene, Effect::motion);
    std::shared_ptr<const Motion> motion = moves ? make_motion(scene.motion) : nullptr;
    if (differ(scene_, scene, Effect::live))
        live_->change(with_live_fields(live_->scene(), scene));
    if (moves)
        lead_->follow(std::move(motion), length_of(scene.motion), world().frame().time);
    scene_ = scene;
}

void Session::build(const SceneDesc& scene) {
    auto lead = std::make_unique<Lead>(make_motion(scene.motion), length_of(scene.motion));
    auto setup = std::make_unique<RunSetup>(prepare(scene, lead->motion()));
    begin(scene, *setup);
    setup_ = std::move(setup);
    lead_ = std::move(lead);
    scene_ = scene;
}

/// As `mane simulate` begins: before the first frame by the preroll, in whole frames.
void Session::begin(const SceneDesc& scene, const RunSetup& setup) {
    const ScheduleDesc& schedule = scene.simulation.schedule;
    const double preroll = std::ceil(double{schedule.preroll} * schedule.frame_rate);
    live_ = std::make_unique<LiveScene>(
        make_live(scene, setup, -preroll / schedule.frame_rate, RunOptions{threads_, "", {}}));
    ++worlds_;
}

} // namespace mane::page
