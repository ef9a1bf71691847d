// Hair on a head that a host leads: the head turns to and fro, the wind rises, a wisp is pinned and
// let go, and the character goes elsewhere at once.
#include "mane/character.h"
#include "mane/driven.h"
#include "mane/style.h"
#include "mane/world.h"

#include <cmath>
#include <cstdio>
#include <memory>

int main() {
    auto head = std::make_shared<mane::DrivenBust>();
    mane::Body bust = mane::make_bust();
    bust.motion = head;
    mane::HairDesc hair;
    hair.style.wisps = 40;
    const mane::Groom groom =
        mane::make_groom(mane::lay_style(hair, bust, mane::bust_scalp(bust)), bust.mesh);

    mane::SimulationDesc desc;
    desc.schedule.frame_rate = 60;
    mane::World world(desc, groom, {bust});
    const std::uint32_t tip = groom.first_section[1] - 1;
    for (int frame = 1; frame <= 180; ++frame) {
        const double turn = 0.6 * std::sin(0.1 * frame); // [rad], wherever it comes from
        mane::HeadPose pose = head->target();
        pose.rotation = {0, std::sin(turn / 2), 0, std::cos(turn / 2)};
        head->move_to(pose, world.frame().time, world.next_time());

        if (frame == 60) {
            desc.air.wind = {3, 0, 0};
            world.change(desc);
        }
        if (frame == 90)
            world.pin({.section = tip});
        if (frame == 120)
            world.release(tip);
        if (frame == 150) {
            head->jump({{5, 0, 0}, {}});
            world.teleport();
        }
        world.advance(); // world.frame() is the hair now, in the world's own memory
    }
    const mane::Frame& now = world.frame();
    std::printf("after %.1f s %zu wisps are at %.1f m\n", now.time, groom.wisp_count(),
                now.origin.x + double{now.position[tip].x});
}
