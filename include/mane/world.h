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
#include <optional>
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
    std::uint64_t intersection_counts = 0; ///< at the first wisp detection of every frame
    std::uint64_t intersections =
        0; ///< pairs (segment, other segment it intersects), summed over those counts
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

/// A section of the hair that is held (M46).
struct Pin {
    std::uint32_t section = 0; ///< of the groom; the first two of a wisp are the head's
    /// [m] Where, in the world or, with `body`, in that body's rest pose; empty: where the section
    /// is now.
    std::optional<Vec3d> place = {};
    std::optional<std::uint32_t> body = {}; ///< whose bone it follows; empty: it stays in the world
    std::uint32_t bone = 0;
    double ease = 0.1; ///< [s] until it is there, over 0
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
    /// When the next frame will be [s]: where a host leads a `DrivenMotion` to.
    double next_time() const;

    /// Other parameters from now on: all that the table of fields calls live. Hair and contacts
    /// stay as they are and answer to the new ones; the same ones again change no bit. Throws
    /// InputError, and then changes nothing, for values that no step can work with, for steps that
    /// would be unstable (M37) and for a fixed field that differs (seed, frames, preroll).
    void change(const SimulationDesc& desc);
    /// Other springs, masses and designs from now on, of the same wisps with the same sections,
    /// rooted at the same places: what `skeleton.strain` or a style's radius asks for, laid anew
    /// (`make_groom`). Hair stays as it is; the new springs take it to the new design, radii too.
    /// Only the two sections on the head, which no spring moves, go over to theirs in the next
    /// frame. Throws InputError, and then changes nothing, for a groom that does not fit or would
    /// be unstable.
    void change(const Groom& groom);
    /// Both at once: values that are stable together need not be one after the other.
    void change(const SimulationDesc& desc, const Groom& groom);
    /// The parameters now.
    const SimulationDesc& desc() const;

    /// Follows a jump of the first body's motion, such as `DrivenBust::jump`: brings the hair from
    /// where the head was at this frame to where its motion has it now, rigidly, at the velocities
    /// that it has relative to the head, and looks for contacts with bodies anew. Without a jump no
    /// bit changes. Throws InputError, and then changes nothing, for a pose that is not finite.
    void teleport();

    /// Holds a section from now on, exactly where the pin says and not by a spring. It goes there
    /// smoothly from where it is, with the velocity it has (C²), over `ease`; the sections beside
    /// it and all that touches it answer to that. Pinned again, it goes to the new place. Nothing
    /// keeps a pin out of a body. Throws InputError, and then changes nothing, for a section on the
    /// head or none, a bone there is not, and numbers that are not finite.
    void pin(const Pin& pin);
    /// Lets a section go, with the velocity it has: from then on the springs move it. Throws
    /// InputError for one that is not pinned.
    void release(std::uint32_t section);
    /// All pins, by when they were first set, each with its place.
    std::vector<Pin> pins() const;

    std::size_t body_count() const;
    const Body& body(std::size_t body) const;

    /// The hair now. This is the world's own frame: its addresses stay the same, and valid, as long
    /// as the world lives; what stands there changes with `advance` and `teleport`.
    const Frame& frame() const;
    /// Vertices of a body now [m], relative to the frame's origin; the world's own, likewise.
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
