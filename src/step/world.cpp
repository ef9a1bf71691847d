#include "mane/world.h"

#include "base/hash.h"
#include "step/check_desc.h"
#include "step/check_groom.h"
#include "step/world_data.h"

#include <string>

namespace mane {
namespace {

constexpr const char* kStageNames[] = {"forces", "wisp detection", "character detection",
                                       "velocities", "positions"};

} // namespace

const char* contact_kind_name(ContactKind kind) {
    static constexpr const char* kNames[] = {"friction", "collision", "sliding"};
    return kNames[static_cast<std::size_t>(kind)];
}

const char* stage_name(Stage stage) {
    return kStageNames[static_cast<std::size_t>(stage)];
}

World::World(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
             double start_time, const RunOptions& options) {
    check_desc(desc);
    if (bodies.empty())
        throw InputError("a world without bodies; expected at least the one that wears the hair");
    check_groom(groom, bodies[0].mesh);
    data_ = std::make_unique<Data>(desc, groom, std::move(bodies), start_time, options);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::advance() {
    data_->advance();
}
void World::change(const SimulationDesc& desc) {
    data_->change(desc);
}
void World::change(const Groom& groom) {
    data_->change(data_->simulation.desc, groom);
}
void World::change(const SimulationDesc& desc, const Groom& groom) {
    data_->change(desc, groom);
}
void World::pin(const Pin& pin) {
    data_->pin(pin);
}
void World::release(std::uint32_t section) {
    data_->release(section);
}
std::vector<Pin> World::pins() const {
    return data_->pins();
}
std::size_t World::body_count() const {
    return data_->cast.count();
}
const Body& World::body(std::size_t body) const {
    return data_->cast.body(body);
}
const SimulationDesc& World::desc() const {
    return data_->simulation.desc;
}
void World::teleport() {
    data_->teleport();
}
double World::next_time() const {
    return data_->next_time();
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
