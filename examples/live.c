/* Hair from a scene, led by an engine, in C: the head turns, a field changes, strands are drawn. */
#include "mane/mane.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void must(mane_result result) {
    if (result == MANE_OK)
        return;
    fprintf(stderr, "%s\n", mane_last_error());
    exit(1);
}

int main(void) {
    const char* scene =
        "[style]\nwisps = 40\n[strands]\ncount = 2000\n[schedule]\nframe_rate = 60\n";
    mane_options options = {.size = sizeof options, .threads = 2};
    mane_world* world = NULL;
    must(mane_create_from_scene_text(scene, ".", &options, &world));

    size_t strands, vertices;
    must(mane_begin_strands(world, 4, &strands, &vertices));
    float* positions = malloc(3 * vertices * sizeof *positions);
    float* widths = malloc(vertices * sizeof *widths);

    mane_frame now = {.size = sizeof now};
    for (int frame = 1; frame <= 120; ++frame) {
        mane_pose head;
        must(mane_head(world, &head));
        const double turn = 0.6 * sin(0.1 * frame); /* [rad] */
        head.rotation[1] = sin(turn / 2), head.rotation[3] = cos(turn / 2);
        must(mane_move_head(world, &head, NULL));
        if (frame == 60)
            must(mane_set_text(world, "skeleton.bending_length", "9 cm"));
        must(mane_advance(world));
        must(mane_get_frame(world, &now)); /* pointers into the world's own memory */
        must(mane_fill_strands(world, 0, strands, positions, widths, vertices));
    }
    size_t end;
    must(mane_first_vertex(world, 1, &end)); /* of the second strand: one past the first's tip */
    printf("after %.1f s the first strand ends at y = %.2f m; %zu strands of %zu vertices\n",
           now.time, now.origin[1] + (double)positions[3 * (end - 1) + 1], strands, vertices);
    free(widths);
    free(positions);
    mane_destroy(world);
    return 0;
}
