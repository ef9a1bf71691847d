#include "host/handle.h"

#include <string>

namespace mane {
namespace {

const float* numbers(const std::vector<Vec3>& vectors) {
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    return vectors.empty() ? nullptr : &vectors[0].x;
}

/// The strands for the parameters of now.
StrandShape& shape_of(mane_world& world) {
    if (world.samples == 0)
        throw InputError("no strands yet; expected mane_begin_strands");
    if (!world.strands) {
        const SceneDesc& scene = world.live.scene();
        world.strands.emplace(world.live.world().groom(), scene.hair.strands, scene.simulation.seed,
                              world.samples,
                              StrandOptions{world.options.threads, world.options.instruction_set});
    }
    return *world.strands;
}

} // namespace
} // namespace mane

using namespace mane;

mane_result mane_get_frame(const mane_world* world, mane_frame* frame) {
    return guarded([&] {
        const World& now = given(world, "world").live.world();
        const Frame& f = now.frame();
        mane_frame known{};
        known.index = f.index;
        known.envelope_points = now.groom().envelope_points;
        known.time = f.time;
        known.next_time = now.next_time();
        known.origin[0] = f.origin.x, known.origin[1] = f.origin.y, known.origin[2] = f.origin.z;
        known.wisp_count = now.groom().wisp_count();
        known.section_count = now.groom().section_count();
        known.first_section = now.groom().first_section.data();
        known.position = numbers(f.position);
        known.velocity = numbers(f.velocity);
        known.first_axis = numbers(f.first_axis);
        known.radius = f.radius.data();
        known.radius_rate = f.radius_rate.data();
        fill_known_part(known, given(frame, "frame"));
    });
}

mane_result mane_body_vertices(const mane_world* world, size_t body, const float** vertices,
                               size_t* vertex_count) {
    return guarded([&] {
        const World& now = given(world, "world").live.world();
        if (body >= now.body_count())
            throw InputError("body " + std::to_string(body) + ": expected one of " +
                             std::to_string(now.body_count()));
        const std::vector<Vec3>& of_body = now.body_vertices(body);
        given(vertex_count, "vertex_count") = of_body.size();
        given(vertices, "vertices") = numbers(of_body);
    });
}

mane_result mane_begin_strands(mane_world* world, uint32_t samples_per_segment,
                               size_t* strand_count, size_t* vertex_count) {
    return guarded([&] {
        given(world, "world");
        if (samples_per_segment == 0)
            throw InputError("samples_per_segment is 0; expected at least 1");
        world->samples = samples_per_segment;
        world->strands.reset();
        world->posed = false;
        const StrandShape& shape = shape_of(*world);
        given(strand_count, "strand_count") = shape.strand_count();
        given(vertex_count, "vertex_count") = shape.vertex_count();
    });
}

mane_result mane_first_vertex(const mane_world* world, size_t strand, size_t* vertex) {
    return guarded([&] {
        if (!given(world, "world").strands)
            throw InputError("no strands yet, or parameters changed; expected mane_begin_strands");
        if (strand > world->strands->strand_count())
            throw InputError("strand " + std::to_string(strand) + ": expected at most " +
                             std::to_string(world->strands->strand_count()));
        given(vertex, "vertex") = world->strands->first_vertex(strand);
    });
}

mane_result mane_fill_strands(mane_world* world, size_t first, size_t count, float* positions,
                              float* widths, size_t vertex_count) {
    return guarded([&] {
        StrandShape& shape = shape_of(given(world, "world"));
        if (first + count < first || first + count > shape.strand_count())
            throw InputError("strands " + std::to_string(first) + " and " + std::to_string(count) +
                             " on; expected at most " + std::to_string(shape.strand_count()));
        const std::size_t vertices = shape.first_vertex(first + count) - shape.first_vertex(first);
        if (vertices > vertex_count)
            throw InputError("room for " + std::to_string(vertex_count) +
                             " vertices; expected at least " + std::to_string(vertices));
        if (vertices == 0)
            return;
        given(positions, "positions");
        given(widths, "widths");
        if (!world->posed)
            shape.pose(world->live.world().frame());
        world->posed = true;
        const std::span to(reinterpret_cast<Vec3*>(positions), vertices);
        if (count == shape.strand_count())
            shape.fill(to, {widths, vertices}); // on all threads
        else
            shape.fill(first, count, to, {widths, vertices});
    });
}

mane_result mane_get_statistics(const mane_world* world, mane_statistics* statistics) {
    return guarded([&] {
        const Statistics& s = given(world, "world").live.world().statistics();
        const auto seconds = [&](Stage stage) {
            return s.stage_seconds[static_cast<std::size_t>(stage)];
        };
        mane_statistics known{};
        known.forces_seconds = seconds(Stage::forces);
        known.wisp_detection_seconds = seconds(Stage::wisp_detection);
        known.character_detection_seconds = seconds(Stage::character_detection);
        known.velocities_seconds = seconds(Stage::velocities);
        known.positions_seconds = seconds(Stage::positions);
        known.steps = s.steps;
        known.wisp_detections = s.wisp_detections;
        known.character_detections = s.character_detections;
        known.intersections = s.intersections;
        known.friction_contacts = s.friction_contacts;
        known.collision_contacts = s.collision_contacts;
        known.sliding_contacts = s.sliding_contacts;
        known.penetration_reactions = s.penetration_reactions;
        known.intersection_counts = s.intersection_counts;
        fill_known_part(known, given(statistics, "statistics"));
    });
}

uint64_t mane_state_hash(const mane_world* world) {
    return world ? world->live.world().state_hash() : 0;
}
