/// Every field of the table that is said to be live, changed while a world runs (M46), and every
/// one that is not.

#include "mane/driven.h"
#include "mane/live_scene.h"
#include "mane/setup.h"
#include "mane/strands.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

using namespace mane;

namespace {

/// Few wisps of few segments, in a gusty wind, on a head that shakes beside a box.
SceneDesc small_scene() {
    SceneDesc scene;
    for (const char* setting :
         {"style.wisps=24", "style.segments=5", "schedule.integration_rate=2000", "air.gusts=0.5",
          "air.wind=[1,0,0]", "motion.shake=30", "motion.shake_rate=2", "strands.count=20000",
          "strands.waves=3", "strands.wave_amplitude=0.2"})
        apply_setting(scene, setting);
    ObstacleDesc box;
    box.size = {0.1f, 0.1f, 0.1f};
    box.keys.resize(1);
    box.keys[0].position = {0.3f, 1.4f, 0};
    scene.obstacles.push_back(box);
    return scene;
}
const SceneDesc& scene() {
    static const SceneDesc small = small_scene();
    return small;
}
const RunSetup& setup() {
    static const RunSetup made = prepare(scene());
    return made;
}

/// Another value that the field takes, near the one it has.
struct Other {
    const FieldInfo& field;

    double real(double x) const {
        const double factor = field.section == "schedule" ? 1.25
                              : field.section == "wisps"  ? 1.5
                                                          : 1.1;
        const double more = x == 0 ? std::min(0.3, field.range.high) : x * factor;
        return more <= field.range.high ? more : x * 0.9;
    }
    Value operator()(bool x) const { return !x; }
    Value operator()(std::uint32_t x) const { return x + std::max(1u, x / 4); }
    Value operator()(float x) const { return static_cast<float>(real(double{x})); }
    Value operator()(double x) const { return real(x); }
    Value operator()(const Ramp& x) const { return Ramp(x.root * 1.1f, x.tip * 1.2f); }
    Value operator()(const Vec3& x) const { return x + Vec3(0.5f, -0.3f, 0.2f); }
    Value operator()(const std::string& x) const {
        if (field.choices.empty())
            return x + "x";
        return std::string(field.choices[0] == x ? field.choices[1] : field.choices[0]);
    }
};
SceneDesc with_other(const SceneDesc& from, const Field& field) {
    SceneDesc other = from;
    // softer is stable where stiffer is not; there is one detection per block at most
    static const std::set<std::string> kLess = {"envelope.mass_share", "envelope.damping",
                                                "envelope.ring_damping", "schedule.wisp_rate"};
    if (kLess.contains(field.key()))
        field.set(other, std::get<float>(field.get(from)) * 0.8f);
    else
        field.set(other, std::visit(Other{field}, field.get(from)));
    return other;
}

bool drawn_only(const Field& f) {
    return f.section == "strands" && f.name != "count";
}

void advance(LiveScene& live, int frames) {
    for (int i = 0; i < frames; ++i)
        live.world().advance();
}
std::uint64_t hash_after(LiveScene& live, int frames) {
    advance(live, frames);
    return live.world().state_hash();
}

/// Whether the two are drawn alike.
bool same_strands(const LiveScene& a, const LiveScene& b) {
    const auto drawn = [](const LiveScene& live) {
        const World& world = live.world();
        return make_strands(world.groom(), world.frame(), live.scene().hair.strands, 1, 2);
    };
    const Curves of_a = drawn(a), of_b = drawn(b);
    return of_a.position == of_b.position && of_a.width == of_b.width;
}

} // namespace

TEST_CASE("every live field changes a running world, and there and back at once changes no bit") {
    LiveScene plain = make_live(scene(), setup());
    const std::uint64_t hashes_of_plain[] = {hash_after(plain, 1), hash_after(plain, 1),
                                             hash_after(plain, 1)};
    int tried = 0;
    for (const Field& f : fields_of<SceneDesc>()) {
        if (!has(f.use, FieldUse::live))
            continue;
        CAPTURE(f.key());
        const SceneDesc other = with_other(scene(), f);
        LiveScene live = make_live(scene(), setup());
        advance(live, 1);
        REQUIRE_NOTHROW(live.change(other));
        CHECK(f.get(live.scene()) == f.get(other));
        REQUIRE_NOTHROW(live.change(scene()));
        CHECK(hash_after(live, 1) == hashes_of_plain[1]);

        REQUIRE_NOTHROW(live.change(other));
        advance(live, 1);
        if (drawn_only(f)) {
            CHECK(live.world().state_hash() == hashes_of_plain[2]);
            CHECK(!same_strands(live, plain));
        } else {
            CHECK(live.world().state_hash() != hashes_of_plain[2]);
        }
        ++tried;
    }
    MESSAGE(tried << " live fields");
    CHECK(tried > 50);
}

TEST_CASE("a live field changed before the first step gives the world that was made with it") {
    for (const Field& f : fields_of<SceneDesc>()) {
        if (!has(f.use, FieldUse::live))
            continue;
        // A style's fields make another design: the world made with it begins there, the other one
        // goes there.
        if (f.section == "style")
            continue;
        CAPTURE(f.key());
        const SceneDesc other = with_other(scene(), f);
        RunSetup other_setup = setup();
        other_setup.groom = grow_hair(other, setup().bodies[0], scene().simulation.gravity);
        LiveScene made = make_live(other, other_setup), changed = make_live(scene(), setup());
        changed.change(other);
        CHECK(made.world().state_hash() == changed.world().state_hash());
        CHECK(hash_after(made, 1) == hash_after(changed, 1));
    }
}

TEST_CASE("fixed fields are refused by name, and the world goes on") {
    LiveScene live = make_live(scene(), setup()), plain = make_live(scene(), setup());
    advance(live, 2);
    advance(plain, 2);
    for (const Field& f : fields_of<SceneDesc>()) {
        if (has(f.use, FieldUse::live))
            continue;
        CAPTURE(f.key());
        std::string message;
        try {
            live.change(with_other(scene(), f));
        } catch (const InputError& error) {
            message = error.what();
        }
        CHECK(message.starts_with(f.key() + ": found "));
        CHECK(message.ends_with("it is fixed while a world runs"));
    }
    SceneDesc without = scene();
    without.obstacles.clear();
    CHECK_THROWS_WITH_AS(live.change(without),
                         "obstacle: found other ones, expected those that there are: it is fixed "
                         "while a world runs",
                         InputError);
    SceneDesc stiff = scene();
    stiff.hair.skeleton.strain = 1e-4f;
    stiff.simulation.gravity = {};
    CHECK_THROWS_AS(live.change(stiff), InputError);
    CHECK(live.world().desc().gravity == scene().simulation.gravity);
    CHECK(hash_after(live, 2) == hash_after(plain, 2));
}

TEST_CASE("wisps with settings of their own keep them when all hair changes, and take others") {
    SceneDesc firm = scene();
    firm.hair.skeleton.bending_length = 0.12f; // stands without help
    SceneDesc own = firm;
    own.overrides.push_back({{3, 4}, {{"skeleton.strain", Value(0.02f)}}});
    LiveScene live = make_live(firm, prepare(firm));
    live.change(own);
    const Groom& groom = live.world().groom();
    const std::uint32_t s = groom.first_section[3] + 1;
    CHECK(double{groom.stretch_stiffness[s]} ==
          doctest::Approx(double{setup().groom.stretch_stiffness[s]} *
                          double{scene().hair.skeleton.strain} / 0.02));
    advance(live, 2);
}

TEST_CASE("a host's motion moves the character in place of the scene's, and a hat follows") {
    SceneDesc with_hat = scene();
    with_hat.obstacles[0].worn = true;
    with_hat.obstacles[0].keys[0].position = {0, 1.75f, 0};
    auto motion = std::make_shared<DrivenBust>();
    const RunSetup made = prepare(with_hat, motion);
    CHECK(made.bodies[0].motion == motion);
    CHECK(made.groom.position == setup().groom.position);
    LiveScene live = make_live(with_hat, made);
    const Vec3 before = live.world().body_vertices(1)[0];
    const Vec3d origin = live.world().frame().origin;
    HeadPose pose = motion->target();
    pose.position.x += 0.01;
    motion->move_to(pose, 0, live.world().next_time());
    live.world().advance();
    const Vec3d moved = live.world().frame().origin + Vec3d(live.world().body_vertices(1)[0]) -
                        (origin + Vec3d(before));
    CHECK(length(moved - Vec3d(0.01, 0, 0)) < 1e-6);
}
