#include "mane/world.h"

#include "base/hash.h"
#include "groom/stability.h"
#include "step/cast.h"
#include "step/placement.h"
#include "step/roots.h"
#include "step/step.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

constexpr const char* kStageNames[] = {"forces", "wisp detection", "character detection",
                                       "velocities", "positions"};

void check_fit(const Groom& groom, const std::vector<Body>& bodies) {
    if (bodies.empty())
        throw InputError("a world without bodies; expected at least the one that wears the hair");
    if (groom.wisp_count() == 0)
        throw InputError("a groom of 0 wisps; expected at least 1");
    if (groom.envelope_points < 3 || groom.envelope_points > kMaxEnvelopePoints)
        throw InputError("a groom with " + std::to_string(groom.envelope_points) +
                         " envelope points; expected 3 to " + std::to_string(kMaxEnvelopePoints));
    const std::size_t triangles = bodies[0].mesh.triangles.size();
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        if (groom.roots[w].triangle >= triangles)
            throw InputError("wisp " + std::to_string(w) + " is rooted in triangle " +
                             std::to_string(groom.roots[w].triangle) +
                             "; expected one of the wearer's " + std::to_string(triangles));
        if (groom.sections(w) < 3)
            throw InputError("wisp " + std::to_string(w) + " has " +
                             std::to_string(groom.sections(w)) +
                             " sections; expected at least 3: two on the head and a tip");
    }
}

} // namespace

const char* contact_kind_name(ContactKind kind) {
    static constexpr const char* kNames[] = {"friction", "collision", "sliding"};
    return kNames[static_cast<std::size_t>(kind)];
}

const char* stage_name(Stage stage) {
    return kStageNames[static_cast<std::size_t>(stage)];
}

struct World::Data {
    Data(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
         double start_time, const RunOptions& options)
        : simulation(desc, groom, options), cast(std::move(bodies)), start(start_time) {
        head_middle = middle_of_roots();
        require_stable_step(simulation.groom, double{desc.air.drag},
                            simulation.schedule.step_seconds());
        simulation.origin = nearby_origin(start);
        simulation.bodies = cast.contact_bodies();
        cast.begin(start, simulation.origin);
        place_groom(simulation, cast, start);
        enter_block(start, simulation.schedule.step_seconds());
        const KernelData data = simulation.kernel_data();
        const std::size_t packets = simulation.layout.packets().size();
        simulation.kernels.move_root_velocities(data, 0, 0, packets);
        simulation.kernels.place_roots(data, 0, 0, packets);
        simulation.kernels.section_frames(data, 0, packets);
        check_roots(simulation.hair(), simulation.bodies, cast.names());
        publish();
    }

    /// The design's roots on average: about the middle of the scalp, in the first body's rest pose.
    Vec3d middle_of_roots() const {
        const Groom& groom = simulation.groom;
        Vec3d sum;
        for (std::size_t w = 0; w < groom.wisp_count(); ++w)
            sum += Vec3d(groom.position[groom.first_section[w] + 1]);
        return sum / static_cast<double>(groom.wisp_count());
    }

    /// An origin near the head, on a coarse binary grid: moving the state between two such origins
    /// rounds next to nothing.
    Vec3d nearby_origin(double time) const {
        const Vec3d p = cast.on_head(head_middle, time);
        const auto snap = [](double x) { return std::floor(x * 16 + 0.5) / 16; };
        return {snap(p.x), snap(p.y), snap(p.z)};
    }

    /// Time [s] of a step's beginning, counted in whole steps so that nothing adds up.
    double step_time(std::uint64_t step) const {
        return start + static_cast<double>(step) * simulation.schedule.step_seconds();
    }

    void follow_head(double time) {
        const Vec3d next = nearby_origin(time);
        const Vec3 shift(simulation.origin - next);
        simulation.origin = next;
        for (std::uint32_t section = 0; section < simulation.groom.section_count(); ++section) {
            const Slot slot = simulation.layout.slot(section);
            simulation.state.position.set(slot, simulation.state.position.vec(slot) + shift);
        }
        cast.begin(time, simulation.origin);
    }

    /// Leads the roots from where the bodies are posed now to where they will be `seconds` later,
    /// and poses the bodies there.
    void enter_block(double time, double seconds) {
        simulation.roots.seconds = static_cast<float>(seconds);
        follow_roots(0);
        cast.advance(time + seconds, seconds, simulation.origin);
        follow_roots(1);
    }
    void follow_roots(int end) {
        follow_scalp(simulation.groom, simulation.layout, cast.body(0).mesh, cast.vertices(0),
                     cast.velocities(0), end, simulation.roots);
    }

    void advance() {
        const Schedule& schedule = simulation.schedule;
        const std::uint64_t first_step = std::uint64_t{frame.index} * schedule.steps();
        follow_head(step_time(first_step));
        simulation.reactions.clear();
        for (std::uint32_t b = 0; b < schedule.blocks(); ++b) {
            const std::uint32_t begin = schedule.block_begin(b), end = schedule.block_begin(b + 1);
            enter_block(step_time(first_step + begin), (end - begin) * schedule.step_seconds());
            StepPlace place{
                .index = 0, .steps = end - begin, .detects_wisps = schedule.detects_wisps(b)};
            for (; place.index < place.steps; ++place.index)
                step(simulation, place, step_time(first_step + begin + place.index));
        }
        ++frame.index;
        publish();
        check_finite();
    }

    void publish() {
        const Groom& groom = simulation.groom;
        const State& state = simulation.state;
        const std::uint32_t k_count = groom.envelope_points;
        frame.time = step_time(std::uint64_t{frame.index} * simulation.schedule.steps());
        frame.origin = simulation.origin;
        frame.first_axis.resize(groom.wisp_count());
        frame.position.resize(groom.section_count());
        frame.velocity.resize(groom.section_count());
        frame.radius.resize(groom.section_count() * k_count);
        frame.radius_rate.resize(groom.section_count() * k_count);
        for (std::size_t p = 0; p < simulation.layout.packets().size(); ++p)
            for (std::uint32_t lane = 0; lane < kLanes; ++lane)
                if (const std::uint32_t w = simulation.layout.packets()[p].wisp[lane];
                    w != Layout::kNoWisp)
                    frame.first_axis[w] =
                        normalized(simulation.root_axis.vec({static_cast<std::uint32_t>(p), lane}));
        for (std::uint32_t section = 0; section < groom.section_count(); ++section) {
            const Slot slot = simulation.layout.slot(section);
            frame.position[section] = state.position.vec(slot);
            frame.velocity[section] = state.velocity.vec(slot);
            for (std::uint32_t k = 0; k < k_count; ++k) {
                frame.radius[section * k_count + k] = state.radius.at(slot, k);
                frame.radius_rate[section * k_count + k] = state.radius_rate.at(slot, k);
            }
        }
    }

    void check_finite() const {
        const std::uint32_t k_count = simulation.groom.envelope_points;
        for (std::uint32_t section = 0; section < simulation.groom.section_count(); ++section) {
            const Vec3 &x = frame.position[section], &v = frame.velocity[section];
            bool finite = std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z);
            for (std::uint32_t k = 0; k < k_count; ++k)
                finite = finite && std::isfinite(frame.radius[section * k_count + k] +
                                                 frame.radius_rate[section * k_count + k]);
            if (!finite)
                throw SimulationError("wisp " + std::to_string(simulation.layout.wisp_of(section)) +
                                      " is not finite at time " + std::to_string(frame.time) +
                                      " s; the motion is too fast for these springs: raise "
                                      "schedule.integration_rate");
        }
    }

    Simulation simulation;
    Cast cast;
    double start;
    Vec3d head_middle; ///< in the first body's rest pose
    Frame frame;
};

World::World(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
             double start_time, const RunOptions& options) {
    check_fit(groom, bodies);
    data_ = std::make_unique<Data>(desc, groom, std::move(bodies), start_time, options);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::advance() {
    data_->advance();
}
const Frame& World::frame() const {
    return data_->frame;
}
const std::vector<Vec3>& World::body_vertices(std::size_t body) const {
    return data_->cast.vertices(body);
}
const Groom& World::groom() const {
    return data_->simulation.groom;
}
const Statistics& World::statistics() const {
    return data_->simulation.statistics;
}
std::vector<Contact> World::contacts() const {
    std::vector<Contact> list;
    if (data_->frame.index == 0)
        return list; // nothing has been looked for
    if (data_->simulation.desc.wisps.mode != WispContactMode::off)
        data_->simulation.wisp_response.list(
            data_->simulation.hair(), data_->simulation.contact_geometry.points().order, list);
    data_->simulation.character_contacts.list(data_->simulation.groom, list);
    return list;
}
const std::vector<Reaction>& World::reactions() const {
    return data_->simulation.reactions;
}
const char* World::instruction_set() const {
    return data_->simulation.kernels.instruction_set;
}

std::uint64_t World::state_hash() const {
    const Frame& f = data_->frame;
    StateHash hash;
    for (double x : {f.origin.x, f.origin.y, f.origin.z})
        hash.add(x);
    for (std::size_t i = 0; i < f.position.size(); ++i)
        for (const Vec3& v : {f.position[i], f.velocity[i]})
            for (float x : {v.x, v.y, v.z})
                hash.add(x);
    hash.add(std::span<const float>(f.radius));
    hash.add(std::span<const float>(f.radius_rate));
    return hash.value();
}

} // namespace mane
