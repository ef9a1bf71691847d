#pragma once

#include "mane/body.h"
#include "mane/contact.h"
#include "mane/desc.h"
#include "mane/error.h"
#include "mane/frame.h"
#include "mane/groom.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mane {

/// The stages of §5.1, as they are timed and named everywhere.
enum class Stage : std::uint8_t {
    forces,
    wisp_detection,
    character_detection,
    velocities,
    positions,
    count
};
const char* stage_name(Stage stage);

/// What a run did, in the paper's terms.
struct Statistics {
    double stage_seconds[static_cast<std::size_t>(Stage::count)] = {};
    std::uint64_t steps = 0;
    std::uint64_t wisp_detections = 0;
    std::uint64_t character_detections = 0;
    std::uint64_t intersections =
        0; ///< pairs (segment, other segment it intersects), summed over detections
    std::uint64_t friction_contacts =
        0; ///< quasi-parallel point contacts, summed over detections (§4.1)
    std::uint64_t collision_contacts =
        0; ///< point contacts of different orientation, summed over detections (§4.1)
    std::uint64_t sliding_contacts =
        0; ///< with the character and obstacles, summed over detections (§4.2)
    std::uint64_t penetration_reactions = 0; ///< points moved out, summed over detections (§4.2)
};

/// One time that a stage ran.
struct StageSpan {
    Stage stage;
    std::chrono::steady_clock::time_point begin, end;
};

/// How a world runs; changes no result.
struct RunOptions {
    unsigned threads = 1;        ///< 0: as many as the machine has
    std::string instruction_set; ///< "": the best of the machine; else avx512, avx2, sse4, scalar
    std::function<void(const StageSpan&)>
        on_stage; ///< called after each stage by the thread in `advance`; must not throw
};

/// A head of hair in motion. Frame 0 is the groom as designed, in the first body's pose at
/// `start_time` minus the preroll, unless told otherwise; each `advance` computes one frame more
/// (§5.1).
class World {
  public:
    /// Copies all it is given. Throws InputError for a step that would be unstable (M37), a root
    /// inside a body (M5), or a groom that does not fit the first body's mesh.
    World(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
          double start_time = 0, const RunOptions& options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// Simulates until the next frame. Throws SimulationError when the state becomes non-finite.
    void advance();
    /// The hair now.
    const Frame& frame() const;
    /// Vertices of a body now [m], relative to the frame's origin.
    const std::vector<Vec3>& body_vertices(std::size_t body) const;

    /// All contacts that are engaged now, wisps' before bodies', each in the order of their
    /// sections. Made anew by each call.
    std::vector<Contact> contacts() const;
    /// The penetration reactions of the last `advance`: detection after detection, each in the
    /// order of the sections. A point may be moved several times.
    const std::vector<Reaction>& reactions() const;
    const Groom& groom() const;
    const Statistics& statistics() const;
    /// A hash over every bit of positions, velocities, radii and rates: equal for any thread count
    /// and instruction set (M39).
    std::uint64_t state_hash() const;
    /// The instruction set in use: avx512, avx2, sse4, scalar, wasm, neon.
    const char* instruction_set() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace mane
