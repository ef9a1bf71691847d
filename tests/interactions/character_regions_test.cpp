/// Clear regions let most sections be passed over: contacts and reactions are those of asking for
/// every one, to the bit.

#include "base/random.h"
#include "character/skinning.h"
#include "interactions/toy_hair.h"
#include "mane/character.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace mane;
using namespace mane::test;

namespace {

constexpr double kBlock = 1.0 / 120;
constexpr std::uint32_t kLines = 4, kSections = 7;
constexpr std::uint32_t kWisps = 120;

Vec3 ball(const Random& random, std::uint64_t n, float size) {
    return {random.between(3 * n, -size, size), random.between(3 * n + 1, -size, size),
            random.between(3 * n + 2, -size, size)};
}

/// A bust that whirls, and a thin plate that sweeps through the hair behind its neck.
struct Stage {
    Body bust = make_bust();
    std::shared_ptr<const Motion> motion = builtin_motion();
    std::vector<BonePose> bones = std::vector<BonePose>(motion->bone_count());
    Mesh plate;
    Surface bust_surface{bust.mesh}, plate_surface;

    Stage() : plate(thin_plate()), plate_surface(plate) {}
    static Mesh thin_plate() {
        Mesh mesh;
        for (int corner = 0; corner < 8; ++corner)
            mesh.vertices.push_back({corner & 1 ? 0.06f : -0.06f, corner & 2 ? 0.08f : -0.08f,
                                     corner & 4 ? 0.001f : -0.001f});
        mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
        return mesh;
    }
    static Vec3d plate_place(double time) { return {1.5 * (time - 5.15), 1.5, -0.13}; }

    void pose(double time, bool reset) {
        std::vector<Vec3> positions(bust.mesh.vertices.size()), velocities(positions.size());
        motion->evaluate(time, bones);
        pose_mesh(bust, bones, {}, positions, velocities);
        std::vector<RigidFrame> frames;
        for (const BonePose& bone : bones)
            frames.push_back({bone.rotation.rotate({1, 0, 0}), bone.rotation.rotate({0, 1, 0}),
                              bone.rotation.rotate({0, 0, 1}), bone.position});
        RigidFrame plate_frame;
        plate_frame.origin = plate_place(time);
        std::vector<Vec3> swept;
        for (const Vec3& p : plate.vertices)
            swept.push_back(Vec3(plate_frame.to_world(Vec3d(p))));
        if (reset) {
            bust_surface.reset(positions, frames);
            plate_surface.reset(swept, {&plate_frame, 1});
        } else {
            bust_surface.advance(positions, kBlock, frames);
            plate_surface.advance(swept, kBlock, {&plate_frame, 1});
        }
    }
    std::vector<ContactBody> bodies() const {
        return {{&bust_surface, false}, {&plate_surface, false}};
    }
};

/// Wisps about the head, in the head's own coordinates. `order` says which wisp has which number.
std::vector<std::vector<Vec3>> scattered(const std::vector<std::uint32_t>& order) {
    const Random random(5, 1);
    std::vector<std::vector<Vec3>> wisps;
    for (const std::uint32_t name : order) {
        std::vector<Vec3> points{Vec3(0, 1.55f, 0) + ball(random, 100 * name, 0.14f)};
        const Vec3 way = ball(random, 100 * name + 1, 0.03f);
        for (std::uint64_t i = 2; i <= kSections; ++i)
            points.push_back(points.back() + way + ball(random, 100 * name + i, 0.015f));
        wisps.push_back(points);
    }
    return wisps;
}

/// Hair that rides on the head and swings about as it likes.
struct Run {
    std::vector<std::uint32_t> order;
    std::vector<std::vector<Vec3>> rest;
    ToyHair hair;
    CharacterContacts contacts;
    Threads threads{1};

    Run(std::vector<std::uint32_t> order_, const Ablation& ablation)
        : order(std::move(order_)), rest(scattered(order)), hair(rest, kLines, 0.012f),
          contacts(ablation) {}

    Vec3 place(const BonePose& head, std::uint32_t w, std::uint32_t i, double time) const {
        const Random random(9, order[w]);
        const Vec3 swing = ball(random, i, 0.04f);
        const auto phase = static_cast<float>(2 * time);
        const float share = 2 * std::abs(phase - std::floor(phase) - 0.5f) - 0.5f;
        const Vec3d p(rest[w][i] + swing * share);
        return Vec3(head.rotation.rotate(p) + head.position);
    }
    void move(Stage& stage, double time) {
        stage.motion->evaluate(time + kBlock, stage.bones);
        const BonePose later = stage.bones[kHeadBone];
        stage.motion->evaluate(time, stage.bones);
        const BonePose now = stage.bones[kHeadBone];
        for (std::uint32_t w = 0; w < kWisps; ++w)
            for (std::uint32_t i = 0; i < kSections; ++i) {
                const Vec3 from = place(now, w, i, time), to = place(later, w, i, time + kBlock);
                const Slot slot = hair.slot(w, i);
                hair.state.position.set(slot, from);
                hair.state.velocity.set(slot, (to - from) / static_cast<float>(kBlock));
                for (std::uint32_t k = 0; k < kLines; ++k)
                    hair.state.radius.at(slot, k) = 0.012f;
            }
        hair.find_frames();
    }
    void detect(const Stage& stage) { contacts.detect(hair.view(), stage.bodies(), {}, threads); }
    std::uint64_t react(Stage& stage, double time) {
        move(stage, time);
        return contacts.react(hair.view(), stage.bodies(), {}, hair.state, threads);
    }
};

std::vector<std::uint32_t> rising() {
    std::vector<std::uint32_t> order(kWisps);
    for (std::uint32_t w = 0; w < kWisps; ++w)
        order[w] = w;
    return order;
}

/// How many contacts of the wisp called `name` are not the same in both runs.
std::size_t differences(const Run& a, std::uint32_t w, const Run& b, std::uint32_t v) {
    const auto of_a = a.contacts.of_wisp(w), of_b = b.contacts.of_wisp(v);
    if (of_a.size() != of_b.size())
        return std::max(of_a.size(), of_b.size());
    std::size_t count = 0;
    for (std::size_t c = 0; c < of_a.size(); ++c)
        count += !(of_a[c] == of_b[c]);
    return count;
}

struct Outcome {
    std::size_t contacts = 0, different = 0, reactions = 0, moved_apart = 0;
};

/// Runs beside one that asks for every section; wisp w of the first is wisp_of[w] of the second.
Outcome compare(Run run, const std::vector<std::uint32_t>& wisp_of, int blocks) {
    Stage stage;
    Run brute(rising(), {.clear_regions = false});
    Outcome outcome;
    const double start = 4.9;
    stage.pose(start, true);
    for (int b = 0; b < blocks; ++b) {
        const double time = start + b * kBlock;
        if (b % 6 == 0)
            stage.pose(time, true); // as at a frame's beginning
        stage.pose(time + kBlock, false);
        for (Run* r : {&run, &brute}) {
            r->move(stage, time);
            r->detect(stage);
        }
        for (std::uint32_t w = 0; w < kWisps; ++w) {
            outcome.contacts += brute.contacts.of_wisp(wisp_of[w]).size();
            outcome.different += differences(run, w, brute, wisp_of[w]);
        }
        const std::uint64_t reactions = brute.react(stage, time + kBlock);
        outcome.reactions += reactions;
        outcome.different += run.react(stage, time + kBlock) != reactions;
        for (std::uint32_t w = 0; w < kWisps; ++w)
            for (std::uint32_t i = 0; i < kSections; ++i) {
                bool apart = run.hair.x(w, i) != brute.hair.x(wisp_of[w], i);
                for (std::uint32_t k = 0; k < kLines; ++k)
                    apart |= run.hair.state.radius.at(run.hair.slot(w, i), k) !=
                             brute.hair.state.radius.at(brute.hair.slot(wisp_of[w], i), k);
                outcome.moved_apart += apart;
            }
    }
    return outcome;
}

} // namespace

TEST_CASE("clear regions change no contact and no reaction, through a whirl and a sweeping plate") {
    const Outcome outcome = compare(Run(rising(), {}), rising(), 60);
    CHECK(outcome.different == 0);
    CHECK(outcome.moved_apart == 0);
    CHECK(outcome.contacts > 5000);
    CHECK(outcome.reactions > 100);
}

TEST_CASE("clear regions do not depend on the order of wisps") {
    std::vector<std::uint32_t> order = rising();
    const Random random(3, 1);
    for (std::uint32_t w = kWisps; w-- > 1;) // any order does
        std::swap(order[w], order[static_cast<std::uint32_t>(random.between(w, 0, float(w)))]);
    const Outcome outcome = compare(Run(order, {}), order, 20);
    CHECK(outcome.different == 0);
    CHECK(outcome.moved_apart == 0);
    CHECK(outcome.contacts > 1000);
}

// The bound is no wider than it must be: a tenth less, and contacts are missed.
TEST_CASE("with nine tenths of the reach, clear regions miss contacts") {
    const Outcome outcome = compare(Run(rising(), {.clear_reach = 0.9f}), rising(), 60);
    CHECK(outcome.different > 0);
}
