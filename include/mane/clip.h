#pragma once

#include "mane/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mane {

/// Captured motion as a BVH file gives it: a tree of joints and, per frame, one number per channel.
/// In the rest pose all rotations are zero, so a joint then sits at the sum of the offsets from the
/// root to it. Units are the file's own.
struct Clip {
    /// What one number of a frame moves. Rotations apply in the order of the channels, the first
    /// outermost.
    enum class Channel : std::uint8_t {
        x_position, ///< [file's unit]
        y_position,
        z_position,
        x_rotation, ///< [deg]
        y_rotation,
        z_rotation,
    };

    struct Joint {
        std::string name; ///< empty for an End Site
        std::int32_t parent =
            -1;       ///< index into `joints`, always smaller than the joint's own; −1: a root
        Vec3d offset; ///< [file's unit] from the parent; replaced by position channels where there
                      ///< are any
        std::vector<Channel> channels;   ///< empty for an End Site
        std::uint32_t first_channel = 0; ///< where the joint's numbers start inside a frame
    };

    std::string source;              ///< the file, for messages
    std::vector<Joint> joints;       ///< parents before children
    std::uint32_t channel_count = 0; ///< numbers per frame
    std::uint32_t frame_count = 0;
    double frame_time = 0;      ///< [s] as the file says; it may be wrong
    std::vector<double> values; ///< frame_count × channel_count

    /// The numbers of one frame.
    const double* frame(std::size_t f) const { return values.data() + f * channel_count; }
};

} // namespace mane
