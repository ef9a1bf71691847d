#include "interactions/toy_hair.h"

#include <algorithm>
#include <cmath>

namespace mane::test {

ToyHair::ToyHair(const std::vector<std::vector<Vec3>>& wisps, std::uint32_t k, float radius) {
    groom.envelope_points = k;
    groom.first_section = {0};
    for (const auto& points : wisps) {
        groom.roots.emplace_back();
        groom.position.insert(groom.position.end(), points.begin(), points.end());
        groom.first_section.push_back(static_cast<std::uint32_t>(groom.position.size()));
    }
    const std::size_t sections = groom.position.size();
    groom.radius.assign(sections * k, radius);
    // bare skeletons carry an envelope of nearly no mass: stopping it at radius 0 gives the
    // skeleton no jolt
    const float share = radius > 0 ? 0.2f : 1e-6f;
    groom.skeleton_mass.assign(sections, 1e-4f * (1 - share));
    groom.envelope_mass.assign(sections, 1e-4f * share / float(k));
    for (auto* per_section : {&groom.stretch_stiffness, &groom.stretch_damping, &groom.rest_length,
                              &groom.bend_stiffness, &groom.bend_damping, &groom.rest_curvature_u,
                              &groom.rest_curvature_v, &groom.radial_stiffness,
                              &groom.radial_damping, &groom.ring_stiffness, &groom.ring_damping})
        per_section->assign(sections, 1);
    for (auto* per_point : {&groom.rest_radius, &groom.ring_length})
        per_point->assign(sections * k, 1);
    groom.thickness_power.assign(wisps.size(), 2);
    layout = std::make_unique<Layout>(groom);
    rest = RestRows(groom, *layout);
    lines = half_lines(k);
    state = State(layout->rows(), k);
    frames = SectionFrames(layout->rows());
    for (std::uint32_t s = 0; s < sections; ++s) {
        state.position.set(layout->slot(s), groom.position[s]);
        for (std::uint32_t line = 0; line < k; ++line)
            state.radius.at(layout->slot(s), line) = radius;
    }
    find_frames();
}

std::vector<Vec3> ToyHair::straight(const Vec3& first, const Vec3& step, int sections) {
    std::vector<Vec3> points;
    for (int i = 0; i < sections; ++i)
        points.push_back(first + step * float(i));
    return points;
}

void ToyHair::find_frames() {
    for (std::uint32_t w = 0; w < groom.wisp_count(); ++w) {
        const std::uint32_t n = groom.sections(w);
        Vec3 u;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Vec3 before = i > 0 ? normalized(x(w, i) - x(w, i - 1)) : Vec3{};
            const Vec3 after = i + 1 < n ? normalized(x(w, i + 1) - x(w, i)) : Vec3{};
            const Vec3 normal = normalized(before + after);
            if (i == 0)
                u = std::abs(normal.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
            u = normalized(u - normal * dot(u, normal));
            if (i == 0)
                u = u * std::cos(turn) + cross(normal, u) * std::sin(turn);
            frames.u.set(slot(w, i), u);
            frames.v.set(slot(w, i), cross(normal, u));
            frames.normal.set(slot(w, i), normal);
        }
    }
}

double ToyHair::energy(const Vec3& frame) const {
    double sum = 0;
    for (std::uint32_t w = 0; w < groom.wisp_count(); ++w) {
        for (std::uint32_t i = 2; i < groom.sections(w); ++i) {
            const std::uint32_t section = groom.first_section[w] + i;
            const Slot s = layout->slot(section);
            const Vec3d v(state.velocity.vec(s) - frame);
            const double m = double(groom.envelope_mass[section]);
            sum += 0.5 * double(groom.skeleton_mass[section]) * dot(v, v);
            for (std::uint32_t line = 0; line < lines.size(); ++line) {
                const Vec3d d = Vec3d(frames.u.vec(s)) * double(lines[line].cosine) +
                                Vec3d(frames.v.vec(s)) * double(lines[line].sine);
                const Vec3d whole = v + d * double(state.radius_rate.at(s, line));
                sum += 0.5 * m * dot(whole, whole);
            }
        }
    }
    return sum;
}

ToyRun::ToyRun(ToyHair& hair_, std::vector<Mesh> bodies_, unsigned thread_count)
    : hair(hair_), rest(std::move(bodies_)), worn(rest.size(), false), now(rest),
      threads(thread_count) {
    for (const Mesh& mesh : rest)
        surfaces.push_back(std::make_unique<Surface>(mesh));
}

std::vector<ContactBody> ToyRun::bodies() const {
    std::vector<ContactBody> all;
    for (std::size_t b = 0; b < surfaces.size(); ++b)
        all.push_back({surfaces[b].get(), worn[b]});
    return all;
}

void ToyRun::block(const Place& place) {
    const double length = double(dt) * steps_per_block;
    for (std::size_t b = 0; b < rest.size(); ++b) {
        const auto pose = [&](double t) {
            std::vector<Vec3> vertices;
            for (const Vec3& v : rest[b].vertices)
                vertices.emplace_back(place(b, t, Vec3d(v)));
            return vertices;
        };
        if (time == 0)
            surfaces[b]->reset(pose(0));
        now[b].vertices = pose(time + length);
        surfaces[b]->advance(now[b].vertices, length);
    }
    contacts.detect(hair.view(), bodies(), desc, threads);
    for (int i = 0; i < steps_per_block; ++i)
        step(float(i) / float(steps_per_block));
    react();
    time += length;
}

void ToyRun::step(float fraction) {
    for (std::uint32_t s = 0; s < hair.groom.section_count(); ++s) {
        const Slot slot = hair.layout->slot(s);
        if (!hair.layout->simulated(s))
            continue;
        const Vec3 v = hair.state.velocity.vec(slot);
        hair.state.velocity.set(slot, v + (gravity - v * air) * dt);
        for (std::uint32_t line = 0; line < hair.groom.envelope_points; ++line)
            hair.state.radius_rate.at(slot, line) *= 1 - air * dt;
    }
    hair.groom.envelope_points <= 4 ? spring_forces<1>() : spring_forces<2>();
    contacts.respond(hair.view(), desc, fraction, dt, hair.state, threads);
    move();
}

template <int kFours> void ToyRun::spring_forces() {
    WispCopy wisp;
    WispMotion<kFours> motion;
    const HairView view = hair.view();
    motion.begin(view);
    const auto push = [&](const WispPoint& point, const Vec3& impulse) {
        MotionRow<kFours> row;
        motion.find_row(point, four(impulse), row);
        motion.weigh(row);
        motion.push(row, 1);
    };
    for (std::uint32_t w = 0; w < hair.groom.wisp_count(); ++w) {
        wisp.load(view, w);
        motion.load(w, 0, wisp.sections());
        for (std::uint32_t i = 1; stretch > 0 && i + 1 < wisp.sections(); ++i) {
            const Vec3 way = wisp.x[i + 1] - wisp.x[i];
            const float mass = 1e-4f;
            const Vec3 t = normalized(way);
            const float force =
                mass * (stretch * (length(way) - rest_length) +
                        0.5f * std::sqrt(stretch) * dot(wisp.v[i + 1] - wisp.v[i], t));
            push({i, 0, 0, 0, 0}, t * (force * dt));
            push({i + 1, 0, 0, 0, 0}, t * (-force * dt));
        }
        for (std::uint32_t i = 2; spring > 0 && i < wisp.sections(); ++i) {
            const float damping = 2 * std::sqrt(spring * hair.groom.envelope_mass[0]);
            for (std::uint32_t line = 0; line < wisp.k(); ++line) {
                const float force =
                    spring * (spring_length - wisp.r(i, line)) - damping * wisp.rate(i, line);
                push({i, 0, line, 1, 0}, wisp.d(i, line) * (force * dt));
                push({i, 0, 0, 0, 0}, wisp.d(i, line) * (-force * dt));
            }
        }
        motion.store(hair.state);
    }
}

void ToyRun::move() {
    auto& state = hair.state;
    for (std::size_t i = 0; i < state.position.all().size(); ++i)
        state.position.all()[i] += dt * state.velocity.all()[i];
    for (std::size_t i = 0; i < state.radius.all().size(); ++i) {
        float& r = state.radius.all()[i];
        r += dt * state.radius_rate.all()[i];
        if (r < 0)
            r = state.radius_rate.all()[i] = 0;
    }
    hair.find_frames();
}

void ToyRun::react() {
    reactions += contacts.react(hair.view(), bodies(), desc, hair.state, threads);
    hair.find_frames();
}

} // namespace mane::test
