#include "scene/section.h"

#include "mane/scene.h"

namespace mane {

template <> inline constexpr std::array<std::string_view, 3> kChoices<WispContactMode>{
    "off", "isotropic", "anisotropic"};
template <> inline constexpr std::array<std::string_view, 3> kChoices<StrandDistribution>{
    "uniform", "gaussian", "rim"};
template <>
inline constexpr std::array<std::string_view, 3> kChoices<ObstacleShape>{"box", "sphere", "mesh"};

namespace {

constexpr FieldUse fixed = FieldUse::fixed, live = FieldUse::live,
                   each = FieldUse::live | FieldUse::per_wisp;
constexpr Range share{0, 1};

// A scene may ask for more than the judge does, never for less.
constexpr CheckDesc limit;
constexpr Range at_most(double bound) {
    return {0, bound};
}
constexpr Range at_least(double bound) {
    return {bound, 1};
}

// clang-format off
constexpr Section<SceneDesc, &SceneDesc::simulation> simulation{"simulation"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::schedule> schedule{"schedule"};
constexpr Section<SceneDesc, &SceneDesc::hair, &HairDesc::style> style{"style"};
constexpr Section<SceneDesc, &SceneDesc::hair, &HairDesc::skeleton> skeleton{"skeleton"};
constexpr Section<SceneDesc, &SceneDesc::hair, &HairDesc::envelope> envelope{"envelope"};
constexpr Section<SceneDesc, &SceneDesc::hair, &HairDesc::strands> strands{"strands"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::air> air{"air"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::wisps> wisps{"wisps"};
constexpr Section<SceneDesc, &SceneDesc::character> wearer{"character"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::character> character{"character"};
constexpr Section<SceneDesc, &SceneDesc::motion> motion{"motion"};
constexpr Section<SceneDesc, &SceneDesc::motion, &MotionDesc::drive> drive{"motion"};
constexpr Section<SceneDesc, &SceneDesc::check> check{"check"};
constexpr Section<ObstacleDesc> obstacle{"obstacle"};
constexpr Section<ObstacleKeyDesc> obstacle_key{"obstacle.key"};

std::vector<Field> scene_table() {
    return {
        simulation.field<&SimulationDesc::seed>("seed", "1", {0, 4294967295.0}, fixed,
            "another number makes other random choices everywhere"),
        simulation.field<&SimulationDesc::gravity>("gravity", "m/s²", {-1000, 1000}, live,
            "the pull on all hair"),

        schedule.field<&ScheduleDesc::frame_rate>("frame_rate", "Hz", {1, 1000}, live,
            "stored frames per second"),
        schedule.field<&ScheduleDesc::frames>("frames", "1", {1, 1000000}, fixed,
            "how many frames to simulate"),
        schedule.field<&ScheduleDesc::preroll>("preroll", "s", {0, 60}, fixed,
            "motion before the first frame, for the hair to gather the character's speed"),
        schedule.field<&ScheduleDesc::integration_rate>("integration_rate", "Hz", {24, 100000}, live,
            "explicit integration steps per second"),
        schedule.field<&ScheduleDesc::character_rate>("character_rate", "Hz", {1, 100000}, live,
            "how often contacts with the character are looked for"),
        schedule.field<&ScheduleDesc::wisp_rate>("wisp_rate", "Hz", {1, 100000}, live,
            "how often contacts between wisps are looked for"),
        schedule.field<&ScheduleDesc::hold_contacts>("hold_contacts", live,
            "contacts stay engaged between detections; false answers them only when found, for study"),

        skeleton.field<&SkeletonDesc::strand_mass>("strand_mass", "kg/m", {1e-7, 1e-2}, each,
            "mass of one strand per length; a wisp has this times its strands"),
        skeleton.field<&SkeletonDesc::strain>("strain", "1", {1e-4, 0.2}, each,
            "stretch of the root segment when the wisp hangs under its own weight; less is stiffer and asks for shorter steps"),
        skeleton.field<&SkeletonDesc::stretch_damping>("stretch_damping", "1", {0, 10}, each,
            "damping ratio of one segment's spring"),
        skeleton.field<&SkeletonDesc::bending_length>("bending_length", "m", {0, 1}, each,
            "how far a wisp stands out before it hangs; more is stiffer"),
        skeleton.field<&SkeletonDesc::bending_damping>("bending_damping", "1", {0, 10}, each,
            "damping ratio of the first bending mode of one bending length"),
        skeleton.field<&SkeletonDesc::thickness_power>("thickness_power", "1", {0, 4}, each,
            "bending stiffness grows with the wisp's radius to this power"),

        envelope.field<&EnvelopeDesc::points>("points", "1", {3, 8}, fixed,
            "envelope points per cross-section"),
        envelope.field<&EnvelopeDesc::mass_share>("mass_share", "1", {0.01, 0.9}, each,
            "share of a section's mass that its envelope points carry"),
        envelope.field<&EnvelopeDesc::squeeze>("squeeze", "1", {0.01, 0.8}, each,
            "loss of radius under the section's own weight; less is stiffer"),
        envelope.field<&EnvelopeDesc::stiffness>("stiffness", "1", {0.001, 100}, each,
            "radial stiffness from root to tip, relative to what squeeze asks"),
        envelope.field<&EnvelopeDesc::damping>("damping", "1", {0, 20}, each,
            "damping ratio of the radial springs"),
        envelope.field<&EnvelopeDesc::ring_stiffness>("ring_stiffness", "1", {0, 10}, each,
            "springs between neighbouring envelope points, relative to the radial ones"),
        envelope.field<&EnvelopeDesc::ring_damping>("ring_damping", "1", {0, 20}, each,
            "damping ratio of the springs between neighbouring envelope points"),

        air.field<&AirDesc::drag>("drag", "1/s", {0, 1000}, live,
            "air resistance: deceleration per velocity relative to the air"),
        air.field<&AirDesc::wind>("wind", "m/s", {-100, 100}, live,
            "the air's mean velocity"),
        air.field<&AirDesc::gusts>("gusts", "m/s", {0, 100}, live,
            "standard deviation of the turbulence around the wind, per axis"),
        air.field<&AirDesc::gust_size>("gust_size", "m", {0.01, 100}, live,
            "size of the largest eddies"),
        air.field<&AirDesc::gust_seed>("gust_seed", "1", {0, 4294967295.0}, live,
            "another number makes other gusts"),

        wisps.field<&WispContactDesc::mode>("mode", live,
            "how wisps answer each other: not at all, by dissipative collisions only, or as in the paper, where quasi-parallel wisps slide"),
        wisps.field<&WispContactDesc::parallel_angle>("parallel_angle", "deg", {0, 90}, live,
            "wisps closer in direction than this may slide into each other"),
        wisps.field<&WispContactDesc::fade_angle>("fade_angle", "deg", {0, 90}, live,
            "under this angle the plane of two wisps fades out"),
        wisps.field<&WispContactDesc::sliding_speed>("sliding_speed", "m/s", {0, 10}, live,
            "relative velocity out of the plane that still counts as sliding"),
        wisps.field<&WispContactDesc::hysteresis>("hysteresis", "1", {1, 10}, live,
            "factor on both limits before a sliding contact becomes a collision"),
        wisps.field<&WispContactDesc::friction>("friction", "1/s", {0, 10000}, live,
            "drag between sliding wisps at rest density"),
        wisps.field<&WispContactDesc::axis_contact_ratio>("axis_contact_ratio", "1", {0, 1000}, live,
            "segments longer than this many diameters also collide axis to axis"),
        wisps.field<&WispContactDesc::literal>("literal", live,
            "the paper's bare half for every point, for study: energy may grow"),

        strands.field<&StrandDesc::count>("count", "1", {0, 10000000}, live,
            "strands on the whole head"),
        strands.field<&StrandDesc::distribution>("distribution", live,
            "where strands stand in a cross-section"),
        strands.field<&StrandDesc::jitter>("jitter", "1", share, live,
            "largest share by which a control point moves toward the skeleton"),
        strands.field<&StrandDesc::length_jitter>("length_jitter", "1", share, live,
            "largest share by which a strand is shortened"),
        strands.field<&StrandDesc::waves>("waves", "1", {0, 1000}, live,
            "waves along a strand"),
        strands.field<&StrandDesc::wave_amplitude>("wave_amplitude", "1", share, live,
            "amplitude of the waves at rest, relative to the wisp's radius"),
        strands.field<&StrandDesc::curls>("curls", "1", {-100, 100}, live,
            "turns that the strands of a wisp make inside it, from the scalp to its tip"),
        strands.field<&StrandDesc::root_width>("root_width", "m", {1e-6, 0.01}, live,
            "a strand's diameter at the root"),
        strands.field<&StrandDesc::tip_width>("tip_width", "m", {0, 0.01}, live,
            "a strand's diameter at the tip"),

        style.field<&StyleDesc::wisps>("wisps", "1", {1, 100000}, fixed,
            "wisps on the head, spread evenly over the scalp"),
        style.field<&StyleDesc::segments>("segments", "1", {1, 200}, fixed,
            "simulated segments per wisp, mean; longer wisps have more"),
        style.field<&StyleDesc::nape_length>("nape_length", "m", {0.01, 3}, fixed,
            "length of the lowest wisps"),
        style.field<&StyleDesc::crown_length>("crown_length", "m", {0.01, 3}, fixed,
            "length of the highest wisps"),
        style.field<&StyleDesc::length_variation>("length_variation", "1", {0, 0.9}, fixed,
            "largest share by which a wisp is shorter at random"),
        style.field<&StyleDesc::root_radius>("root_radius", "m", {0.0005, 0.2}, live,
            "half width of a wisp at its root"),
        style.field<&StyleDesc::radius>("radius", "m", {0.0005, 0.2}, live,
            "half width of a wisp where it is widest"),
        style.field<&StyleDesc::tip_radius>("tip_radius", "m", {0.0005, 0.2}, live,
            "half width of a wisp at its tip"),
        style.field<&StyleDesc::widest>("widest", "1", {0.01, 0.99}, live,
            "where along a wisp it is widest, from root to tip"),
        style.field<&StyleDesc::thickness>("thickness", "1", {0.05, 5}, live,
            "depth of a wisp, away from the head, relative to its width"),
        style.field<&StyleDesc::hairline>("hairline", "m", {0, 0.1}, fixed,
            "roots keep this distance from the edge of the scalp"),
        style.field<&StyleDesc::parting>("parting", "m", {-0.2, 0.2}, fixed,
            "the parting line's distance from the middle, to the character's left"),
        style.field<&StyleDesc::parting_width>("parting_width", "m", {0, 0.1}, fixed,
            "no wisp is rooted this near to the parting line"),
        style.field<&StyleDesc::comb_side>("comb_side", "1", {0, 10}, fixed,
            "how much hair is combed away from the parting; 0: not at all"),
        style.field<&StyleDesc::comb_back>("comb_back", "1", {0, 10}, fixed,
            "how much hair in front is combed back from the face"),
        style.field<&StyleDesc::front>("front", "1", share, fixed,
            "hair rooted before this share of the scalp, 0 at its rear, falls over the shoulders to the front"),
        style.field<&StyleDesc::root_angle>("root_angle", "deg", {0, 90}, live,
            "between a wisp and the scalp where it leaves it"),
        style.field<&StyleDesc::drape>("drape", "m", {0.001, 1}, live,
            "way over which a wisp gives in to the comb and to gravity"),
        style.field<&StyleDesc::volume>("volume", "m", {0, 0.3}, live,
            "how far the highest wisps stand off the ones below"),
        style.field<&StyleDesc::variation>("variation", "deg", {0, 90}, live,
            "largest random turn of a wisp at its root"),

        wearer.field<&CharacterDesc::mesh>("mesh", fixed | FieldUse::path,
            "OBJ file, closed or nearly so; empty: the built-in bust"),
        wearer.field<&CharacterDesc::unit>("unit", "m", {1e-6, 1000}, fixed,
            "one unit of the mesh's coordinates; 0.01 for centimetres"),
        wearer.field<&CharacterDesc::offset>("offset", "m", {-1000, 1000}, fixed,
            "moves the mesh, so that its head turns where the bust's does"),
        wearer.field<&CharacterDesc::scalp_centre>("scalp_centre", "m", {-1000, 1000}, fixed,
            "middle of the ball whose triangles are the scalp, in the rest pose"),
        wearer.field<&CharacterDesc::scalp_radius>("scalp_radius", "m", {0, 10}, fixed,
            "of that ball; 0: the built-in bust's own scalp"),
        character.field<&CharacterContactDesc::threshold>("threshold", "m", {1e-5, 0.1}, live,
            "sliding contact starts at this distance from the surface"),
        character.field<&CharacterContactDesc::push_out>("push_out", "m", {0, 0.1}, live,
            "distance to which a skeleton point that went inside is moved out; under the threshold"),
        character.field<&CharacterContactDesc::friction>("friction", "1/s", {0, 10000}, live,
            "viscous drag on skin"),

        motion.field<&MotionDesc::clip>("clip", fixed | FieldUse::path,
            "BVH file; empty: the built-in motion"),
        drive.field<&ClipMotionDesc::unit>("unit", "m", {1e-6, 1000}, fixed,
            "one unit of the clip's positions"),
        drive.field<&ClipMotionDesc::fps>("fps", "Hz", {0, 10000}, fixed,
            "true frame rate of the clip; 0: as the file says"),
        drive.field<&ClipMotionDesc::first>("first", "1", {0, 4294967295.0}, fixed,
            "frame of the clip that is time 0"),
        drive.field<&ClipMotionDesc::last>("last", "1", {0, 4294967295.0}, fixed,
            "last frame of the clip that is used"),
        drive.field<&ClipMotionDesc::earliest>("earliest", "1", {0, 4294967295.0}, fixed,
            "first frame of the clip that is captured motion; those before it are never used, not in the preroll either"),
        drive.field<&ClipMotionDesc::lowpass>("lowpass", "Hz", {0, 1000}, fixed,
            "cut-off of the low-pass filter; it decides on the peak accelerations; 0: none"),
        drive.field<&ClipMotionDesc::chest>("chest", fixed,
            "joint that drives the chest; empty: found by its usual names"),
        drive.field<&ClipMotionDesc::neck>("neck", fixed,
            "joint that drives the neck; empty: found by its usual names"),
        drive.field<&ClipMotionDesc::head>("head", fixed,
            "joint that drives the head; empty: found by its usual names"),
        motion.field<&MotionDesc::shake>("shake", "deg", {0, 60}, fixed,
            "where there is no clip, the head shakes by this to both sides instead of the built-in motion; 0: it does not"),
        motion.field<&MotionDesc::shake_rate>("shake_rate", "Hz", {0.01, 10}, fixed,
            "how often it does so"),
        motion.field<&MotionDesc::still>("still", fixed,
            "the character does not move at all"),
        motion.field<&MotionDesc::freeze>("freeze", "s", {0, 100000}, fixed,
            "from this time on the motion comes to rest; 0: never"),

        check.field<&CheckDesc::strands_deep>("strands_deep", "1", at_most(limit.strands_deep), fixed,
            "share of strand vertices deeper than 2 mm in a body, over the run, that `mane check` lets pass"),
        check.field<&CheckDesc::strands_deep_frame>("strands_deep_frame", "1", at_most(limit.strands_deep_frame), fixed,
            "the same in any one frame"),
        check.field<&CheckDesc::axis_through>("axis_through", "s", at_most(limit.axis_through), fixed,
            "how long the axis of a segment may stay in a body"),
        check.field<&CheckDesc::stretch>("stretch", "1", at_most(limit.stretch), fixed,
            "how much longer than at rest a segment of a straight style may get"),
        check.field<&CheckDesc::area>("area", "1", at_least(limit.area), fixed,
            "how much of their designed area all sections of a frame must keep"),
        check.field<&CheckDesc::drawn_envelope>("drawn_envelope", "1", at_most(limit.drawn_envelope), fixed,
            "how far a strand may leave its wisp, in local radii"),
        check.field<&CheckDesc::reach>("reach", "1", at_most(limit.reach), fixed,
            "how far a tip may be from its root, in lengths of the wisp"),
        check.field<&CheckDesc::rest_speed>("rest_speed", "m/s", at_most(limit.rest_speed), fixed,
            "how fast hair may be from 3 s after the motion stopped"),
        check.field<&CheckDesc::still_speed>("still_speed", "m/s", at_most(limit.still_speed), fixed,
            "how fast hair may be from 6 s after the motion stopped"),
        check.field<&CheckDesc::rest_jitter>("rest_jitter", "m/s", at_most(limit.rest_jitter), fixed,
            "motion above 10 Hz that may be left from 3 s after the motion stopped"),
    };
}

std::vector<FieldOf<ObstacleDesc>> obstacle_table() {
    return {
        obstacle.field<&ObstacleDesc::name>("name", fixed,
            "for messages and pictures"),
        obstacle.field<&ObstacleDesc::shape>("shape", fixed,
            "a box, an ellipsoid or a file"),
        obstacle.field<&ObstacleDesc::size>("size", "m", {1e-4, 1000}, fixed,
            "of a box or ellipsoid, along its axes"),
        obstacle.field<&ObstacleDesc::mesh>("mesh", fixed | FieldUse::path,
            "OBJ file, for the shape \"mesh\""),
        obstacle.field<&ObstacleDesc::unit>("unit", "m", {1e-6, 1000}, fixed,
            "one unit of the mesh's coordinates"),
        obstacle.field<&ObstacleDesc::worn>("worn", fixed,
            "a hat: it moves with the head, from where its first key puts it in the rest pose; wisps may start inside it"),
    };
}

std::vector<FieldOf<ObstacleKeyDesc>> obstacle_key_table() {
    return {
        obstacle_key.field<&ObstacleKeyDesc::time>("time", "s", {-100000, 100000}, fixed,
            "when the obstacle is there; times rise from key to key"),
        obstacle_key.field<&ObstacleKeyDesc::position>("position", "m", {-1000, 1000}, fixed,
            "of the obstacle's own origin"),
        obstacle_key.field<&ObstacleKeyDesc::rotation>("rotation", "deg", {-36000, 36000}, fixed,
            "about this axis, by its length: [0, 90, 0] is a quarter turn to the left"),
    };
}
// clang-format on

template <typename Root> void add_infos(std::vector<const FieldInfo*>& all) {
    for (const FieldOf<Root>& field : fields_of<Root>())
        all.push_back(&field);
}

} // namespace

template <> std::span<const Field> fields_of() {
    static const std::vector<Field> table = scene_table();
    return table;
}
template <> std::span<const FieldOf<ObstacleDesc>> fields_of() {
    static const std::vector<FieldOf<ObstacleDesc>> table = obstacle_table();
    return table;
}
template <> std::span<const FieldOf<ObstacleKeyDesc>> fields_of() {
    static const std::vector<FieldOf<ObstacleKeyDesc>> table = obstacle_key_table();
    return table;
}

std::span<const FieldInfo* const> all_fields() {
    static const std::vector<const FieldInfo*> all = [] {
        std::vector<const FieldInfo*> infos;
        add_infos<SceneDesc>(infos);
        add_infos<ObstacleDesc>(infos);
        add_infos<ObstacleKeyDesc>(infos);
        return infos;
    }();
    return all;
}

} // namespace mane
