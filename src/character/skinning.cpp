#include "character/skinning.h"

#include "mane/error.h"

#include <string>

namespace mane {
namespace {

// A bone's pose and its derivative, ready to be applied: nine multiplications a vertex each instead
// of a quaternion's product.
struct BoneMatrix {
    Vec3d x, y, z, shift; // columns; shift from the origin
    Vec3d x_rate, y_rate, z_rate, shift_rate;

    BoneMatrix() = default;
    BoneMatrix(const BonePose& bone, const Vec3d& origin)
        : x(bone.rotation.rotate({1, 0, 0})), y(bone.rotation.rotate({0, 1, 0})),
          z(bone.rotation.rotate({0, 0, 1})), shift(bone.position - origin),
          x_rate(cross(bone.angular_velocity, x)), y_rate(cross(bone.angular_velocity, y)),
          z_rate(cross(bone.angular_velocity, z)), shift_rate(bone.velocity) {}

    Vec3d position(const Vec3d& p) const { return x * p.x + y * p.y + z * p.z + shift; }
    Vec3d velocity(const Vec3d& p) const {
        return x_rate * p.x + y_rate * p.y + z_rate * p.z + shift_rate;
    }
};

constexpr std::size_t kMostBones = 256; // their matrices are on the stack

void pose_rigid(const Body& body, const BoneMatrix& bone, std::span<Vec3> positions,
                std::span<Vec3> velocities) {
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Vec3d rest(body.mesh.vertices[v]);
        positions[v] = Vec3(bone.position(rest));
        velocities[v] = Vec3(bone.velocity(rest));
    }
}

} // namespace

void pose_mesh(const Body& body, std::span<const BonePose> bones, const Vec3d& origin,
               std::span<Vec3> positions, std::span<Vec3> velocities) {
    if (bones.size() > kMostBones)
        throw InputError(body.name + ": " + std::to_string(bones.size()) +
                         " bones, expected at most " + std::to_string(kMostBones));
    BoneMatrix matrices[kMostBones];
    for (std::size_t b = 0; b < bones.size(); ++b)
        matrices[b] = BoneMatrix(bones[b], origin);
    if (body.skin.bones.empty()) {
        pose_rigid(body, matrices[0], positions, velocities);
        return;
    }
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Vec3d rest(body.mesh.vertices[v]);
        Vec3d position, velocity;
        for (std::size_t k = 0; k < Skin::kInfluences; ++k) {
            const double weight = body.skin.weights[v][k];
            if (weight == 0)
                continue;
            const BoneMatrix& bone = matrices[body.skin.bones[v][k]];
            position += bone.position(rest) * weight;
            velocity += bone.velocity(rest) * weight;
        }
        positions[v] = Vec3(position);
        velocities[v] = Vec3(velocity);
    }
}

} // namespace mane
