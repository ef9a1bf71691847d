#pragma once

#include "mane/world.h"
#include "step/cast.h"
#include "step/roots.h"
#include "step/simulation.h"

namespace mane {

/// A world: its simulation, the bodies that it acts with, and where it is in time.
struct World::Data {
    Data(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
         double start_time, const RunOptions& options);

    void advance();
    void change(const SimulationDesc& desc) { change(desc, nullptr); }
    void change(const SimulationDesc& desc, const Groom& groom) { change(desc, &groom); }
    void teleport();
    void pin(const Pin& pin);
    void release(std::uint32_t section);
    std::vector<Pin> pins() const;
    double next_time() const { return step_time(simulation.schedule.steps()); }

    Simulation simulation;
    Cast cast;
    Vec3d head_middle; ///< middle of the roots, in the first body's rest pose
    Frame frame;

  private:
    /// From where on time is counted in steps of one length, so that nothing adds up.
    struct Epoch {
        double time = 0; ///< [s]
        std::uint32_t frame = 0;
        Schedule schedule;
    };

    /// A pinned section goes to its place by and by: beside it by an offset that falls to nothing.
    struct Pinned {
        Pin pin;                   ///< its place given
        double begun = 0;          ///< [s]
        Vec3d offset, offset_rate; ///< [m], [m/s] then
    };
    struct Moving {
        Vec3d position, velocity; ///< [m], [m/s] in the world
    };

    /// The one of the next frame: it began when the steps were last changed.
    Epoch epoch() const {
        const Schedule& now = simulation.schedule;
        return now.same_steps(epoch_.schedule) ? epoch_ : Epoch{frame.time, frame.index, now};
    }
    /// Time [s] at the beginning of a step of the next frame; of its last one, and one more: at its
    /// end.
    double step_time(std::uint32_t step) const {
        const Epoch e = epoch();
        const std::uint64_t before = std::uint64_t{frame.index - e.frame} * e.schedule.steps();
        return e.time + static_cast<double>(before + step) * e.schedule.step_seconds();
    }
    Vec3d middle_of_roots() const;
    Vec3d nearby_origin(double time) const;
    void follow_head(double time);
    void enter_block(double time, double seconds);
    void follow_roots(int end);
    void lead_roots(double time);
    void place_roots(double time);
    void carry_hair(const BonePose& from, const BonePose& to);
    void change(const SimulationDesc& desc, const Groom* groom);
    void take_groom(Groom&& groom, RestRows&& rest);
    void lead_radii_on_head();
    Pin checked(const Pin& pin) const;
    Moving target(const Pin& pin, double time) const;
    void begin_pin(Pinned& pinned) const;
    Moving on_the_way(const Pinned& pinned, double time) const;
    void lead_held(double time, double seconds, double begin, double end);
    void carry_pins(const BonePose& from, const BonePose& to);
    void publish();
    void check_finite() const;

    Epoch epoch_;
    RootChange root_change_;   ///< over the next frame, after a change of groom
    BonePose head_;            ///< the first body's, at the frame
    std::vector<Pinned> pins_; ///< one per point of `simulation.held`
};

} // namespace mane
