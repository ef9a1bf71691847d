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
    drawing, ///< strands alone
    motion,  ///< of the character
    step,    ///< how the world is stepped
    hair,    ///< other hair: the same wisps with other springs, or a world of its own
};

Effect effect_of(const FieldInfo& field) {
    const std::string_view section = field.section, name = field.name;
    if (section == "motion")
        return Effect::motion;
    if (section == "strands" && name != "count")
        return Effect::drawing;
    if (section == "check" || name == "frames" || name == "preroll")
        return Effect::drawing; // of no meaning here; kept for who copies the scene
    const bool stepped = section == "simulation" || section == "air" || section == "wisps" ||
                         section == "schedule" ||
                         (section == "character" && has(field.use, FieldUse::live));
    return stepped && name != "seed" ? Effect::step : Effect::hair;
}

/// Whether two scenes differ in a field of this effect.
bool differ(const SceneDesc& a, const SceneDesc& b, Effect effect) {
    for (const Field& f : fields_of<SceneDesc>())
        if (effect_of(f) == effect && to_toml(f.get(a)) != to_toml(f.get(b)))
            return true;
    return false;
}

/// Whether springs can be changed from one to the other, and nothing else.
bool same_wisps(const Groom& a, const Groom& b) {
    return a.envelope_points == b.envelope_points && a.first_section == b.first_section &&
           a.roots == b.roots && a.strands == b.strands;
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
    begin(scene_, *setup_);
}

void Session::advance() {
    lead_->advance(world_->frame().time, world_->next_time());
    world_->advance();
}

void Session::teleport(const Vec3d& by) {
    lead_->jump(by, world_->frame().time);
    world_->teleport();
}

void Session::pin(std::uint32_t section, const Vec3d& place) {
    constexpr double kEase = 0.06; // [s] a hand's places come many times a second
    Pin pin;
    pin.section = section;
    pin.place = place;
    pin.ease = kEase;
    world_->pin(pin);
}

void Session::release(std::uint32_t section) {
    world_->release(section);
}

void Session::release_all() {
    for (const Pin& pin : world_->pins())
        world_->release(pin.section);
}

void Session::change_to(const SceneDesc& scene) {
    std::unique_ptr<RunSetup> hair;
    if (differ(scene_, scene, Effect::hair)) {
        hair = std::make_unique<RunSetup>(prepare(scene));
        if (!same_wisps(hair->groom, world_->groom())) {
            begin(scene, *hair);
            setup_ = std::move(hair);
            scene_ = scene;
            return;
        }
    }
    const bool moves = differ(scene_, scene, Effect::motion);
    std::shared_ptr<const Motion> motion = moves ? make_motion(scene.motion) : nullptr;
    SimulationDesc desc = scene.simulation; // how long a run is says nothing to this one
    desc.schedule.frames = world_->desc().schedule.frames;
    desc.schedule.preroll = world_->desc().schedule.preroll;
    if (hair) {
        world_->change(desc, hair->groom);
        setup_->groom = std::move(hair->groom);
    } else {
        world_->change(desc);
    }
    if (moves) {
        setup_->bodies[0].motion = motion;
        lead_->follow(std::move(motion), length_of(scene.motion), world_->frame().time);
    }
    scene_ = scene;
}

void Session::build(const SceneDesc& scene) {
    auto setup = std::make_unique<RunSetup>(prepare(scene));
    begin(scene, *setup);
    setup_ = std::move(setup);
    scene_ = scene;
}

/// As `mane simulate` begins: before the first frame by the preroll, in whole frames.
void Session::begin(const SceneDesc& scene, const RunSetup& setup) {
    const ScheduleDesc& schedule = scene.simulation.schedule;
    const double preroll = std::ceil(double{schedule.preroll} * schedule.frame_rate);
    std::vector<Body> bodies = setup.bodies;
    Lead lead(bodies[0].motion, length_of(scene.motion));
    for (Body& body : bodies)
        if (body.worn)
            body.motion = following_motion(lead.motion(), bodies[0].head_bone);
    bodies[0].motion = lead.motion();
    auto world =
        std::make_unique<World>(scene.simulation, setup.groom, std::move(bodies),
                                -preroll / schedule.frame_rate, RunOptions{threads_, "", {}});
    world_ = std::move(world);
    lead_ = std::move(lead);
    ++worlds_;
}

} // namespace mane::page
