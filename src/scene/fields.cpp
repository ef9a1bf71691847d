#include "scene/section.h"

#include "mane/scene.h"

namespace mane {

template <> inline constexpr std::array<std::string_view, 3> kChoices<WispContactMode>{
    "off", "isotropic", "anisotropic"};
template <> inline constexpr std::array<std::string_view, 3> kChoices<StrandDistribution>{
    "uniform", "gaussian", "rim"};

namespace {

constexpr FieldUse fixed = FieldUse::fixed, live = FieldUse::live,
                   each = FieldUse::live | FieldUse::per_wisp;
constexpr Range share{0, 1};

constexpr Section<SceneDesc, &SceneDesc::simulation> simulation{"simulation"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::schedule> schedule{
    "schedule"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::air> air{"air"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::wisps> wisps{"wisps"};
constexpr Section<SceneDesc, &SceneDesc::simulation, &SimulationDesc::character> character{
    "character"};
constexpr Section<SceneDesc, &SceneDesc::skeleton> skeleton{"skeleton"};
constexpr Section<SceneDesc, &SceneDesc::envelope> envelope{"envelope"};
constexpr Section<SceneDesc, &SceneDesc::strands> strands{"strands"};

// clang-format off: a table
std::vector<Field> make_scene_fields() {
    return {
        simulation.field<&SimulationDesc::seed>(
            "seed", "1", {0, 4294967295.0}, fixed,
            "another number makes other random choices everywhere"),
        simulation.field<&SimulationDesc::gravity>("gravity", "m/s²", {-1000, 1000}, live,
                                                   "the pull on all hair"),

        schedule.field<&ScheduleDesc::frame_rate>("frame_rate", "Hz", {1, 1000}, fixed,
                                                  "stored frames per second"),
        schedule.field<&ScheduleDesc::frames>("frames", "1", {1, 1000000}, fixed,
                                              "how many frames to simulate"),
        schedule.field<&ScheduleDesc::preroll>(
            "preroll", "s", {0, 60}, fixed,
            "motion before the first frame, for the hair to gather the character's speed"),
        schedule.field<&ScheduleDesc::integration_rate>(
            "integration_rate", "Hz", {24, 100000}, fixed, "explicit integration steps per second"),
        schedule.field<&ScheduleDesc::character_rate>(
            "character_rate", "Hz", {1, 100000}, fixed,
            "how often contacts with the character are looked for"),
        schedule.field<&ScheduleDesc::wisp_rate>("wisp_rate", "Hz", {1, 100000}, fixed,
                                                 "how often contacts between wisps are looked for"),
        schedule.field<&ScheduleDesc::hold_contacts>(
            "hold_contacts", fixed,
            "contacts stay engaged between detections; false answers them only when found, for "
            "study"),

        skeleton.field<&SkeletonDesc::strand_mass>(
            "strand_mass", "kg/m", {1e-7, 1e-2}, each,
            "mass of one strand per length; a wisp has this times its strands"),
        skeleton.field<&SkeletonDesc::strain>(
            "strain", "1", {1e-4, 0.2}, each,
            "stretch of the root segment when the wisp hangs under its own weight; less is stiffer "
            "and asks for shorter steps"),
        skeleton.field<&SkeletonDesc::stretch_damping>("stretch_damping", "1", {0, 10}, each,
                                                       "damping ratio of one segment's spring"),
        skeleton.field<&SkeletonDesc::bending_length>(
            "bending_length", "m", {0, 1}, each,
            "how far a wisp stands out before it hangs; more is stiffer"),
        skeleton.field<&SkeletonDesc::bending_damping>(
            "bending_damping", "1", {0, 10}, each,
            "damping ratio of the first bending mode of one bending length"),
        skeleton.field<&SkeletonDesc::thickness_power>(
            "thickness_power", "1", {0, 4}, each,
            "bending stiffness grows with the wisp's radius to this power"),

        envelope.field<&EnvelopeDesc::points>("points", "1", {3, 16}, fixed,
                                              "envelope points per cross-section"),
        envelope.field<&EnvelopeDesc::mass_share>(
            "mass_share", "1", {0.01, 0.9}, each,
            "share of a section's mass that its envelope points carry"),
        envelope.field<&EnvelopeDesc::squeeze>(
            "squeeze", "1", {0.01, 0.8}, each,
            "loss of radius under the section's own weight; less is stiffer"),
        envelope.field<&EnvelopeDesc::stiffness>(
            "stiffness", "1", {0.001, 100}, each,
            "radial stiffness from root to tip, relative to what squeeze asks"),
        envelope.field<&EnvelopeDesc::damping>("damping", "1", {0, 20}, each,
                                               "damping ratio of the radial springs"),
        envelope.field<&EnvelopeDesc::ring_stiffness>(
            "ring_stiffness", "1", {0, 10}, each,
            "springs between neighbouring envelope points, relative to the radial ones"),
        envelope.field<&EnvelopeDesc::ring_damping>(
            "ring_damping", "1", {0, 20}, each,
            "damping ratio of the springs between neighbouring envelope points"),

        air.field<&AirDesc::drag>("drag", "1/s", {0, 1000}, live,
                                  "air resistance: deceleration per velocity relative to the air"),
        air.field<&AirDesc::wind>("wind", "m/s", {-100, 100}, live, "the air's mean velocity"),
        air.field<&AirDesc::gusts>(
            "gusts", "m/s", {0, 100}, live,
            "standard deviation of the turbulence around the wind, per axis"),
        air.field<&AirDesc::gust_size>("gust_size", "m", {0.01, 100}, fixed,
                                       "size of the largest eddies"),
        air.field<&AirDesc::gust_seed>("gust_seed", "1", {0, 4294967295.0}, fixed,
                                       "another number makes other gusts"),

        wisps.field<&WispContactDesc::mode>(
            "mode", live,
            "how wisps answer each other: not at all, by dissipative collisions only, or as in the "
            "paper, where quasi-parallel wisps slide"),
        wisps.field<&WispContactDesc::parallel_angle>(
            "parallel_angle", "deg", {0, 90}, live,
            "wisps closer in direction than this may slide into each other"),
        wisps.field<&WispContactDesc::fade_angle>(
            "fade_angle", "deg", {0, 90}, live,
            "under this angle the plane of two wisps fades out"),
        wisps.field<&WispContactDesc::sliding_speed>(
            "sliding_speed", "m/s", {0, 10}, live,
            "relative velocity out of the plane that still counts as sliding"),
        wisps.field<&WispContactDesc::hysteresis>(
            "hysteresis", "1", {1, 10}, live,
            "factor on both limits before a sliding contact becomes a collision"),
        wisps.field<&WispContactDesc::friction>("friction", "1/s", {0, 10000}, live,
                                                "drag between sliding wisps at rest density"),
        wisps.field<&WispContactDesc::axis_contact_ratio>(
            "axis_contact_ratio", "1", {0, 1000}, live,
            "segments longer than this many diameters also collide axis to axis"),
        wisps.field<&WispContactDesc::literal>(
            "literal", live, "the paper's bare half for every point, for study: energy may grow"),

        character.field<&CharacterContactDesc::threshold>(
            "threshold", "m", {1e-5, 0.1}, live,
            "sliding contact starts at this distance from the surface"),
        character.field<&CharacterContactDesc::push_out>(
            "push_out", "m", {0, 0.1}, live,
            "distance to which a skeleton point that went inside is moved out; under the "
            "threshold"),
        character.field<&CharacterContactDesc::friction>("friction", "1/s", {0, 10000}, live,
                                                         "viscous drag on skin"),

        strands.field<&StrandDesc::count>("count", "1", {0, 10000000}, fixed,
                                          "strands on the whole head"),
        strands.field<&StrandDesc::distribution>("distribution", live,
                                                 "where strands stand in a cross-section"),
        strands.field<&StrandDesc::jitter>(
            "jitter", "1", share, live,
            "largest share by which a control point moves toward the skeleton"),
        strands.field<&StrandDesc::length_jitter>("length_jitter", "1", share, live,
                                                  "largest share by which a strand is shortened"),
        strands.field<&StrandDesc::waves>("waves", "1", {0, 1000}, live, "waves along a strand"),
        strands.field<&StrandDesc::wave_amplitude>(
            "wave_amplitude", "1", share, live,
            "amplitude of the waves at rest, relative to the wisp's radius"),
        strands.field<&StrandDesc::root_width>("root_width", "m", {1e-6, 0.01}, live,
                                               "a strand's diameter at the root"),
        strands.field<&StrandDesc::tip_width>("tip_width", "m", {0, 0.01}, live,
                                              "a strand's diameter at the tip"),
    };
}
// clang-format on

} // namespace

std::span<const Field> scene_fields() {
    static const std::vector<Field> fields = make_scene_fields();
    return fields;
}

const Field* find_field(std::string_view section, std::string_view name) {
    for (const Field& f : scene_fields())
        if (f.section == section && f.name == name)
            return &f;
    return nullptr;
}

} // namespace mane
