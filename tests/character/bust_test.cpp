#include "crossings.h"

#include "base/hash.h"
#include "character/bust_chain.h"
#include "character/bust_shape.h"
#include "character/head_turn.h"
#include "character/skinning.h"
#include "mane/character.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>

using namespace mane;

namespace {

const Body& bust() {
    static const Body body = make_bust();
    return body;
}

using DirectedEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

DirectedEdges directed_edges(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    DirectedEdges edges;
    for (const auto& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++edges[{t[k], t[(k + 1) % 3]}];
    return edges;
}

Vec3d corner(const Mesh& mesh, std::size_t t, std::size_t k) {
    return Vec3d(mesh.vertices[mesh.triangles[t][k]]);
}

std::vector<Vec3> posed(const HeadTurn& turn) {
    BonePose bones[kBustBones];
    const BustJoints joints = bust_joints();
    pose_from_chest(joints, {joints.chest, {}}, bust_turning({}, {turn, {}}), bones);
    std::vector<Vec3> positions(bust().mesh.vertices.size()), velocities(positions.size());
    pose_mesh(bust(), bones, {}, positions, velocities);
    return positions;
}

} // namespace

TEST_CASE("the bust is one closed manifold surface without handles, seen from outside "
          "counter-clockwise") {
    const Mesh& mesh = bust().mesh;
    CHECK(mesh.triangles.size() >= 3000);
    CHECK(mesh.triangles.size() <= 9000);
    const DirectedEdges edges = directed_edges(mesh.triangles);
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    const auto count = [](std::size_t n) { return static_cast<long>(n); };
    // 2 for one sphere; were it two surfaces, the walk below would not reach all triangles
    CHECK(count(mesh.vertices.size()) - count(edges.size() / 2) + count(mesh.triangles.size()) ==
          2);

    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            owner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    std::set<std::size_t> reached{0};
    std::vector<std::size_t> open{0};
    while (!open.empty()) {
        const auto t = mesh.triangles[open.back()];
        open.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = owner.at({t[(k + 1) % 3], t[k]});
            if (reached.insert(next).second)
                open.push_back(next);
        }
    }
    CHECK(reached.size() == mesh.triangles.size());

    double volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        volume += dot(cross(corner(mesh, t, 0), corner(mesh, t, 1)), corner(mesh, t, 2)) / 6;
    CHECK(volume > 0.010); // [m³] positive: outward; a head has about 4 litres, the chest the rest
    CHECK(volume < 0.025);
}

TEST_CASE("the bust's vertices lie on its shape, its triangles are wide, and those of the face are "
          "fine") {
    const Mesh& mesh = bust().mesh;
    for (const Vec3& v : mesh.vertices)
        CHECK(std::fabs(bust_distance(Vec3d(v))) < 2e-4);
    double face_edges = 0, face_count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d a = corner(mesh, t, 0), b = corner(mesh, t, 1), c = corner(mesh, t, 2);
        const double edges = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
        const Vec3d area = cross(b - a, c - a);
        CHECK(2 * std::sqrt(3.0) * length(area) / edges >
              0.5); // 1: equilateral; ½: one angle of 19°
        const Vec3d centre = (a + b + c) / 3.0;
        const double h = 1e-5;
        const Vec3d gradient(
            bust_distance(centre + Vec3d(h, 0, 0)) - bust_distance(centre - Vec3d(h, 0, 0)),
            bust_distance(centre + Vec3d(0, h, 0)) - bust_distance(centre - Vec3d(0, h, 0)),
            bust_distance(centre + Vec3d(0, 0, h)) - bust_distance(centre - Vec3d(0, 0, h)));
        CHECK(dot(normalized(area), normalized(gradient)) > 0.5);
        if (length(centre - Vec3d(0, 1.50, 0.10)) < 0.03) {
            face_edges += std::sqrt(edges / 3);
            ++face_count;
        }
    }
    CHECK(face_edges / face_count < 0.006);
}

TEST_CASE("the bust has the measures of a woman of 1.65 m who faces +Z") {
    Vec3 low(9, 9, 9), high(-9, -9, -9);
    float head_width = 0, back = 0, neck_front = -9, neck_back = 9, neck_side = 0, chin = 9;
    Vec3 nose(0, 0, -9);
    for (const Vec3& v : bust().mesh.vertices) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        if (v.y > 1.57f)
            head_width = std::max(head_width, v.x); // over the ears
        if (v.y > 1.53f)
            back = std::min(back, v.z);
        if (v.y > 1.48f && v.z > nose.z)
            nose = v;
        if (std::fabs(v.y - 1.40f) < 0.01f && std::fabs(v.x) < 0.03f) {
            neck_front = std::max(neck_front, v.z);
            neck_back = std::min(neck_back, v.z);
        }
        if (std::fabs(v.y - 1.43f) < 0.01f)
            neck_side = std::max(neck_side, v.x);
        if (v.z > 0.055f && v.y > 1.40f)
            chin = std::min(chin, v.y);
    }
    CHECK(high.y == doctest::Approx(1.65).epsilon(0.005));
    CHECK((chin > 1.42 && chin < 1.44));                        // head height 0.22 m
    CHECK(head_width == doctest::Approx(0.0735).epsilon(0.05)); // breadth 0.147 m
    CHECK((nose.y > 1.485 && nose.y < 1.52));
    CHECK(std::fabs(nose.x) < 0.004);
    CHECK((nose.z - back > 0.19f && nose.z - back < 0.225f));
    CHECK((neck_side > 0.045f && neck_side < 0.065f)); // girth about 0.32 m
    CHECK((neck_front - neck_back > 0.09f && neck_front - neck_back < 0.13f));
    CHECK((high.x > 0.17f && high.x < 0.21f)); // shoulders
    CHECK(low.x == doctest::Approx(-high.x).epsilon(0.01));
}

TEST_CASE("skin weights add up to one, the skull is the head's, the chest the chest's") {
    const Skin& skin = bust().skin;
    REQUIRE(skin.weights.size() == bust().mesh.vertices.size());
    CHECK(bust().head_bone == kHeadBone);
    for (std::size_t v = 0; v < skin.weights.size(); ++v) {
        float sum = 0, of[kBustBones] = {};
        for (std::size_t k = 0; k < Skin::kInfluences; ++k) {
            CHECK(skin.weights[v][k] >= 0);
            sum += skin.weights[v][k];
            of[skin.bones[v][k]] += skin.weights[v][k];
        }
        CHECK(sum == doctest::Approx(1).epsilon(1e-6));
        const Vec3& p = bust().mesh.vertices[v];
        if (p.y > 1.53f)
            CHECK(of[kHeadBone] == 1);
        if (p.y > 1.43f && p.z > 0.06f)
            CHECK(of[kHeadBone] > 0.98f); // the chin
        if (p.y < 1.31f)
            CHECK(of[kChestBone] == 1);
    }
}

TEST_CASE("the bust does not pass through itself at rest, turning, nodding or leaning") {
    const double degree = 3.14159265358979 / 180;
    CHECK(Crossings(bust().mesh, bust().mesh.vertices).count() == 0);
    for (const HeadTurn& turn :
         {HeadTurn{60, 0, 0}, HeadTurn{-60, 0, 0}, HeadTurn{0, 40, 0}, HeadTurn{0, -40, 0},
          HeadTurn{0, 0, 30}, HeadTurn{60, 25, 0}, HeadTurn{-60, -25, 0}}) {
        CAPTURE(turn.yaw);
        CAPTURE(turn.pitch);
        const HeadTurn radians{turn.yaw * degree, turn.pitch * degree, turn.roll * degree};
        CHECK(Crossings(bust().mesh, posed(radians)).count() == 0);
    }
}

TEST_CASE("a mesh that passes through itself is found out") {
    const std::vector<Vec3> far = posed({0, 1.9, 0}); // the chin in the chest
    CHECK(Crossings(bust().mesh, far).count() > 0);
}

TEST_CASE("the scalp is one patch inside the hairline: no face, no ears, no neck, the same on both "
          "sides") {
    const std::vector<std::uint32_t> scalp = bust_scalp(bust());
    const Mesh& mesh = bust().mesh;
    std::vector<std::array<std::uint32_t, 3>> patch;
    double area = 0, left = 0;
    Vec3d front, nape(0, 9, 0);
    for (std::size_t i = 0; i < scalp.size(); ++i) {
        if (i > 0)
            CHECK(scalp[i] > scalp[i - 1]);
        const Vec3d a = corner(mesh, scalp[i], 0), b = corner(mesh, scalp[i], 1),
                    c = corner(mesh, scalp[i], 2);
        patch.push_back(mesh.triangles[scalp[i]]);
        const double part = length(cross(b - a, c - a)) / 2;
        area += part;
        left += a.x > 0 ? part : 0;
        if (a.z > front.z)
            front = a;
        if (a.y < nape.y)
            nape = a;
        CHECK(ear_distance(a) > 0);
    }
    CHECK((area > 0.05 && area < 0.075)); // [m²] a person's scalp has 0.06 to 0.07
    CHECK(left == doctest::Approx(area / 2).epsilon(0.03));
    CHECK((front.y > 1.59 && front.y < 1.63));
    CHECK((nape.y > 1.46 && nape.y < 1.5));
    CHECK(nape.z < -0.04);
    // one patch without holes: Euler characteristic of a disc
    const DirectedEdges edges = directed_edges(patch);
    std::set<std::uint32_t> vertices;
    std::size_t sides = 0;
    for (const auto& t : patch)
        vertices.insert(t.begin(), t.end());
    for (const auto& [edge, count] : edges)
        if (edge.first < edge.second || edges.count({edge.second, edge.first}) == 0)
            ++sides;
    CHECK(static_cast<long>(vertices.size()) - static_cast<long>(sides) +
              static_cast<long>(patch.size()) ==
          1);
}

TEST_CASE("the bust has the same bits everywhere") {
    StateHash hash;
    for (const Vec3& v : bust().mesh.vertices)
        for (float x : {v.x, v.y, v.z})
            hash.add(x);
    for (const auto& t : bust().mesh.triangles)
        for (std::uint32_t v : t)
            hash.add(std::uint64_t{v});
    for (const auto& w : bust().skin.weights)
        hash.add(w);
    CHECK(hash.value() == 13051950563864013964u);
}
