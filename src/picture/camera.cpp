#include "picture/camera.h"

#include <cmath>

namespace mane {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

// Degrees from the face to the camera, about the vertical; positive toward the character's left,
// +X.
double bearing(View view) {
    switch (view) {
    case View::face:
        return 0;
    case View::three_quarter:
        return 40;
    case View::profile:
        return 90;
    case View::back:
        break;
    }
    return 180;
}

// Where the head faces, in the horizontal plane. Looking straight up or down, the neck's direction
// tells.
Vec3d heading(const Quatd& rotation) {
    const Vec3d face = rotation.rotate({0, 0, 1}), crown = rotation.rotate({0, 1, 0});
    const double tilt = 0.9;
    const Vec3d forward = face.y > tilt ? -crown : face.y < -tilt ? crown : face;
    return normalized(Vec3d{forward.x, 0, forward.z});
}

} // namespace

Camera camera_for(View view, const HeadPose& head, double frame_height) {
    const Vec3d forward = heading(head.rotation), left = cross(Vec3d{0, 1, 0}, forward);
    const double angle = bearing(view) * kRadians;
    const Vec3d toward = forward * std::cos(angle) + left * std::sin(angle) + Vec3d{0, 0.08, 0};
    Camera camera;
    camera.target =
        head.centre - Vec3d{0, 0.22 * frame_height, 0}; // hair hangs: more is below than above
    camera.eye = camera.target +
                 toward * (0.5 * frame_height / std::tan(camera.field_of_view / 2 * kRadians));
    return camera;
}

Lens::Lens(const Camera& camera, const Vec3d& origin, std::uint32_t width, std::uint32_t height)
    : eye_(camera.eye - origin), forward_(normalized(camera.target - camera.eye)),
      right_(normalized(cross(forward_, Vec3(camera.up)))), up_(cross(right_, forward_)),
      half_width_(0.5f * static_cast<float>(width)),
      half_height_(0.5f * static_cast<float>(height)),
      pixel_(static_cast<float>(std::tan(camera.field_of_view / 2 * kRadians)) / half_height_) {}

Vec3 Lens::direction(float x, float y) const {
    return normalized(forward_ + right_ * ((x - half_width_) * pixel_) +
                      up_ * ((half_height_ - y) * pixel_));
}

} // namespace mane
