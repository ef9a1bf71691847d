#include "step/schedule.h"

#include "mane/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mane {
namespace {

std::uint32_t per_frame(float rate, float frame_rate, const char* name) {
    if (!(rate > 0) || !std::isfinite(rate))
        throw InputError("schedule." + std::string(name) + " is " + std::to_string(rate) +
                         "; expected a rate over 0 Hz");
    // A rate that is a multiple of the frame rate but for rounding does not cost one count more.
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(double{rate} / frame_rate - 1e-6)));
}

} // namespace

Schedule::Schedule(const ScheduleDesc& desc) {
    if (!(desc.frame_rate > 0) || !std::isfinite(desc.frame_rate))
        throw InputError("schedule.frame_rate is " + std::to_string(desc.frame_rate) +
                         "; expected a rate over 0 Hz");
    steps_ = per_frame(desc.integration_rate, desc.frame_rate, "integration_rate");
    blocks_ = std::min(steps_, per_frame(desc.character_rate, desc.frame_rate, "character_rate"));
    wisp_detections_ = std::min(blocks_, per_frame(desc.wisp_rate, desc.frame_rate, "wisp_rate"));
    step_seconds_ = 1.0 / (double{desc.frame_rate} * steps_);
}

} // namespace mane
