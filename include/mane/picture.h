#pragma once

#include "mane/desc.h"
#include "mane/frame.h"
#include "mane/groom.h"
#include "mane/vec.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// A quick ray-traced picture of one frame, to look at what a simulation did. Built where Embree 3
/// and libpng are found.

namespace mane {

/// Rows from the top, three bytes a pixel, sRGB.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 3>> pixels;
};

/// What is drawn of the hair; the bodies are always there.
enum class PictureLayer : std::uint8_t { strands, skeleton, envelope, character };

/// Where the camera stands, from the head: it turns with the head's heading and stays upright.
enum class View : std::uint8_t { face, three_quarter, profile, back };

/// A camera in the world.
struct Camera {
    Vec3d eye;                 ///< [m]
    Vec3d target;              ///< [m] seen in the middle of the picture
    Vec3d up = {0, 1, 0};      ///< seen upright
    double field_of_view = 24; ///< [deg] over the picture's height
};

/// Where the head is: presets of the camera need it.
struct HeadPose {
    Vec3d centre;   ///< [m] in the world, between the ears
    Quatd rotation; ///< from the rest pose, where the head faces +Z
};

/// A body as it is in the frame: the character first, then obstacles.
struct PictureBody {
    std::span<const Vec3> vertices; ///< [m] relative to the frame's origin
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

struct PictureDesc {
    std::uint32_t width = 640, height = 640; ///< [pixels]
    std::uint32_t samples = 16;              ///< [1] rays per pixel
    PictureLayer layer = PictureLayer::strands;
    std::uint32_t strands =
        30000; ///< [1] drawn; fewer than the description's are drawn wider, to cover as much
    bool colour_by_wisp = false; ///< each wisp in a colour of its own
    Vec3 hair_colour = {0.36f, 0.17f,
                        0.075f}; ///< [1] linear: light that is left after passing a strand
    View view = View::three_quarter;
    double frame_height =
        0.95; ///< [m] seen by a preset view, around the head and what hangs from it
    std::optional<Camera> camera = {}; ///< in place of `view`
    unsigned threads = 2;              ///< 0: as many as the machine has; changes no pixel
};

/// The camera of a preset view.
Camera camera_for(View view, const HeadPose& head, double frame_height);

/// Ray-traces one frame. Throws InputError for a frame that does not fit the groom, or a picture
/// without pixels or samples.
Image render(const Groom& groom, const Frame& frame, const StrandDesc& strands, std::uint32_t seed,
             std::span<const PictureBody> bodies, const HeadPose& head, const PictureDesc& desc);

/// Images of one size side by side, `columns` in a row, with a short ASCII label (may be empty)
/// above each.
Image contact_sheet(std::span<const Image> images, std::span<const std::string> labels,
                    std::uint32_t columns);

/// Writes a PNG file: beside its place first, and renamed when whole. Throws InputError with the
/// path and the system's reason.
void write_png(const Image& image, const std::filesystem::path& path);

} // namespace mane
