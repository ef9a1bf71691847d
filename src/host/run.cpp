#include "host/handle.h"

#include <string>

namespace mane {
namespace {

Pose pose_of(const mane_pose& pose) {
    const double *p = pose.position, *q = pose.rotation;
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
}

DrivenBust& bust_of(const mane_world& world) {
    if (!world.bodies.empty())
        throw InputError("the bodies of this world were given as arrays; expected mane_move_body");
    if (!world.bust)
        throw InputError("the head of this world moves as its scene says (scene_motion)");
    return *world.bust;
}

void teleport(mane_world& world, const Pose& by) {
    if (world.bodies.empty())
        bust_of(world).jump(by);
    for (std::size_t b = 0; b < world.bodies.size(); ++b)
        if (b == 0 || world.live.world().body(b).worn)
            world.bodies[b]->jump(by);
    world.live.world().teleport();
    world.posed = false;
}

Pin pin_of(const mane_pin& known) {
    Pin pin;
    pin.section = known.section;
    if (known.has_place)
        pin.place = Vec3d(known.place[0], known.place[1], known.place[2]);
    if (known.follows)
        pin.body = known.body;
    pin.bone = known.bone;
    if (known.ease != 0)
        pin.ease = known.ease;
    return pin;
}

} // namespace
} // namespace mane

using namespace mane;

mane_result mane_advance(mane_world* world) {
    return guarded([&] {
        given(world, "world").live.world().advance();
        world->posed = false;
    });
}

mane_result mane_move_head(mane_world* world, const mane_pose* head, const double* chest) {
    return guarded([&] {
        const Pose pose = pose_of(given(head, "head"));
        const World& now = given(world, "world").live.world();
        HeadPose to{pose.position, pose.rotation, {}};
        if (chest)
            to.chest = {chest[0], chest[1], chest[2], chest[3]};
        bust_of(*world).move_to(to, now.frame().time, now.next_time());
    });
}

mane_result mane_head(const mane_world* world, mane_pose* head) {
    return guarded([&] {
        const auto [p, q, chest] = bust_of(given(world, "world")).target();
        given(head, "head") = {{p.x, p.y, p.z}, {q.x, q.y, q.z, q.w}};
    });
}

mane_result mane_move_body(mane_world* world, size_t body, const mane_pose* bones,
                           size_t bone_count) {
    return guarded([&] {
        if (body >= given(world, "world").bodies.size())
            throw InputError("body " + std::to_string(body) + ": expected one of " +
                             std::to_string(world->bodies.size()) + " given as arrays");
        if (bone_count > 0)
            given(bones, "bones");
        std::vector<Pose> poses;
        for (std::size_t b = 0; b < bone_count; ++b)
            poses.push_back(pose_of(bones[b]));
        const World& now = world->live.world();
        world->bodies[body]->move_to(poses, now.frame().time, now.next_time());
    });
}

mane_result mane_teleport(mane_world* world, const mane_pose* by) {
    return guarded([&] { teleport(given(world, "world"), pose_of(given(by, "by"))); });
}

mane_result mane_hold(mane_world* world, const mane_pin* pin) {
    return guarded(
        [&] { given(world, "world").live.world().pin(pin_of(known_part(given(pin, "pin")))); });
}

mane_result mane_release(mane_world* world, uint32_t section) {
    return guarded([&] { given(world, "world").live.world().release(section); });
}
