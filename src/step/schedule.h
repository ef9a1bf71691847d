#pragma once

#include "mane/desc.h"

#include <cstdint>

namespace mane {

/// When each part of the step runs (§5.3, M36): whole numbers per frame, the same pattern in every
/// frame. A frame has `steps` integration steps in `blocks` detection blocks; the mesh and the
/// roots are known at the blocks' ends.
class Schedule {
  public:
    /// Throws InputError for a frame rate or rate that is not positive.
    explicit Schedule(const ScheduleDesc& desc);

    std::uint32_t steps() const { return steps_; }
    std::uint32_t blocks() const { return blocks_; }
    std::uint32_t wisp_detections() const { return wisp_detections_; }
    /// [s] of one integration step.
    double step_seconds() const { return step_seconds_; }
    /// Whether frames and steps are as long as another's.
    bool same_steps(const Schedule& other) const {
        return steps_ == other.steps_ && step_seconds_ == other.step_seconds_;
    }
    /// First step of block b in [0, blocks]; a character detection follows the last step of each
    /// block.
    std::uint32_t block_begin(std::uint32_t b) const {
        return static_cast<std::uint32_t>(std::uint64_t{b} * steps_ / blocks_);
    }
    /// Whether contacts between wisps are looked for at the beginning of block b.
    bool detects_wisps(std::uint32_t b) const {
        return std::uint64_t{b} * wisp_detections_ % blocks_ < wisp_detections_;
    }

  private:
    std::uint32_t steps_, blocks_, wisp_detections_;
    double step_seconds_;
};

} // namespace mane
