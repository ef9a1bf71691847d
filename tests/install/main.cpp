// Four wisps in the wind for three frames, in a world without any file.
#include <mane/style.h>
#include <mane/world.h>

#ifdef HAS_FORMATS
#include <mane/cache.h>
#include <mane/scene.h>
#endif

#include <cstdio>
#include <vector>

int main() {
    const mane::Body peg = mane::make_peg();
    std::vector<mane::WispDesign> wisps;
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
        mane::StraightWisp wisp;
        wisp.triangle = triangle;
        wisp.length = 0.2f;
        wisps.push_back(mane::design(wisp, peg.mesh));
    }
    const mane::Groom groom = mane::make_groom(wisps, peg.mesh);
    mane::SimulationDesc desc;
    desc.air.wind = {1, 0, 0};
    mane::World world(desc, groom, {peg});
    const float before = world.frame().position.back().x;
    for (int frame = 0; frame < 3; ++frame)
        world.advance();
    const float moved = world.frame().position.back().x - before;
    std::printf("wind moved a tip by %g m\n", static_cast<double>(moved));

#ifdef HAS_FORMATS
    mane::SceneDesc scene;
    mane::apply_setting(scene, "air.wind=[1, 0, 0]");
    {
        mane::CacheWriter cache("installed.mane", {mane::write_scene(scene), groom, {peg}});
        cache.add(world.frame(), {{}});
        cache.finish();
    }
    if (mane::CacheReader("installed.mane").frame(0).position != world.frame().position)
        return 1;
    std::puts("its cache gives the frame back");
#endif
    return moved > 0.001f ? 0 : 1;
}
