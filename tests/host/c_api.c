/* The flat C interface, as a C program uses it (C99): made from arrays and from a scene, led,
 * changed, pinned, read, and every kind of error. Prints the line that ./test.sh counts. */
#include "mane/mane.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: %s; last error: %s\n", __FILE__, __LINE__, #condition,         \
                    mane_last_error());                                                            \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)
#define REFUSED(call, message)                                                                     \
    do {                                                                                           \
        CHECK((call) == MANE_INPUT_ERROR);                                                         \
        if (strcmp(mane_last_error(), message) != 0) {                                             \
            fprintf(stderr, "%s:%d: found \"%s\", expected \"%s\"\n", __FILE__, __LINE__,          \
                    mane_last_error(), message);                                                   \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

enum { SECTIONS = 8, POINTS = 4 };

/* A tetrahedron, as mane::make_peg, with a wisp that hangs from its lower face. */
static const float corners[] = {-0.025f, -0.02f, -0.02f, 0.025f, -0.02f, -0.02f,
                                0,       -0.02f, 0.03f,  0,      0.03f,  0};
static const uint32_t faces[] = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};

static mane_body peg(void) {
    mane_body body = {.size = sizeof body,
                      .name = "peg",
                      .vertices = corners,
                      .vertex_count = 4,
                      .triangles = faces,
                      .triangle_count = 4};
    return body;
}

static mane_world* make_world(uint32_t threads) {
    float position[3 * SECTIONS], radius[POINTS * SECTIONS];
    for (int i = 0; i < SECTIONS; ++i) {
        position[3 * i] = 0;
        position[3 * i + 1] = i == 0 ? -0.01f : -0.03f - 0.04f * (float)(i - 1);
        position[3 * i + 2] = -0.00333f;
        for (int k = 0; k < POINTS; ++k)
            radius[POINTS * i + k] = 0.008f;
    }
    const uint32_t first_section[] = {0, SECTIONS}, triangle[] = {0};
    const float barycentric[] = {0.3333333f, 0.3333333f, 0.3333334f}, first_axis[] = {1, 0, 0};
    const mane_hair hair = {.size = sizeof hair,
                            .wisp_count = 1,
                            .first_section = first_section,
                            .position = position,
                            .radius = radius,
                            .triangle = triangle,
                            .barycentric = barycentric,
                            .first_axis = first_axis};
    const mane_body body = peg();
    const double wind[] = {1, 0, 0};
    const mane_setting settings[] = {{"air.wind", NULL, wind, 3},
                                     {"strands.count", "500", NULL, 0},
                                     {"schedule.integration_rate", "2400", NULL, 0},
                                     {"skeleton.bending_length", "6 cm", NULL, 0}};
    const mane_options options = {.size = sizeof options, .threads = threads};
    mane_world* world = NULL;
    CHECK(mane_create(&body, 1, &hair, settings, 4, &options, &world) == MANE_OK);
    REFUSED(mane_create(&body, 0, &hair, NULL, 0, NULL, &world),
            "no bodies; expected at least the one that wears the hair");
    REFUSED(mane_create(&body, 1, NULL, NULL, 0, NULL, &world), "hair is NULL");
    mane_hair broken = hair;
    broken.radius = NULL;
    REFUSED(mane_create(&body, 1, &broken, NULL, 0, NULL, &world), "radius is NULL");
    broken.size = 0;
    REFUSED(mane_create(&body, 1, &broken, NULL, 0, NULL, &world),
            "a struct without its size; expected `size` to be its sizeof");
    mane_body open = body;
    open.vertex_count = 3;
    REFUSED(mane_create(&open, 1, &hair, NULL, 0, NULL, &world),
            "body 0: triangle 1 names vertex 3; expected one of 3");
    return world;
}

static mane_frame frame_of(const mane_world* world) {
    mane_frame frame = {.size = sizeof frame};
    CHECK(mane_get_frame(world, &frame) == MANE_OK);
    return frame;
}

static void test_running(void) {
    mane_world *world = make_world(1), *twin = make_world(3);
    const mane_frame before = frame_of(world);
    CHECK(before.index == 0 && before.wisp_count == 1 && before.section_count == SECTIONS);
    CHECK(before.envelope_points == POINTS && before.first_section[1] == SECTIONS);
    CHECK(fabs(before.next_time - 1.0 / 24) < 1e-12);
    const float tip = before.position[3 * (SECTIONS - 1)];
    for (int i = 0; i < 12; ++i) {
        const double turn = 0.1 * i;
        const mane_pose pose = {{0.002 * i, 0, 0}, {0, sin(turn / 2), 0, cos(turn / 2)}};
        CHECK(mane_move_body(world, 0, &pose, 1) == MANE_OK);
        CHECK(mane_move_body(twin, 0, &pose, 1) == MANE_OK);
        CHECK(mane_advance(world) == MANE_OK);
        CHECK(mane_advance(twin) == MANE_OK);
    }
    CHECK(mane_state_hash(world) == mane_state_hash(twin));
    CHECK(mane_state_hash(world) != 0);
    const mane_frame now = frame_of(world);
    CHECK(now.index == 12 && now.position == before.position && now.radius == before.radius);
    CHECK(now.position[3 * (SECTIONS - 1)] > tip + 0.001f); /* blown */
    /* the body is where it was led to */
    const float* vertices = NULL;
    size_t count = 0;
    CHECK(mane_body_vertices(world, 0, &vertices, &count) == MANE_OK && count == 4);
    CHECK(fabs(now.origin[0] + (double)vertices[9] - 0.022) < 1e-6); /* the top is on the axis */
    REFUSED(mane_body_vertices(world, 1, &vertices, &count), "body 1: expected one of 1");

    mane_statistics statistics = {.size = sizeof statistics};
    CHECK(mane_get_statistics(world, &statistics) == MANE_OK && statistics.steps == 12 * 100);
    /* a caller of an older version, which knows less */
    mane_statistics shorter = {.size = offsetof(mane_statistics, wisp_detections)};
    shorter.wisp_detections = 77;
    CHECK(mane_get_statistics(world, &shorter) == MANE_OK);
    CHECK(shorter.steps == 12 * 100 && shorter.wisp_detections == 77);

    const uint64_t hash = mane_state_hash(world);
    const mane_pose nothing = {{0, 0, 0}, {0, 0, 0, 1}}, far = {{7, 0, 0}, {0, 1, 0, 0}},
                    broken = {{0, 0, 0}, {0, 0, 0, 0}};
    CHECK(mane_teleport(world, &nothing) == MANE_OK && mane_state_hash(world) == hash);
    REFUSED(mane_teleport(world, &broken),
            "a pose whose rotation is not finite or the zero quaternion");
    CHECK(mane_teleport(world, &far) == MANE_OK && mane_state_hash(world) != hash);
    CHECK(fabs(frame_of(world).origin[0] - 7) < 0.2);
    CHECK(mane_advance(world) == MANE_OK);
    const mane_pose two[] = {nothing, nothing};
    REFUSED(mane_move_body(world, 0, two, 2), "2 poses for a motion of 1 bones");
    REFUSED(mane_move_body(world, 3, &nothing, 1), "body 3: expected one of 1 given as arrays");
    REFUSED(mane_move_head(world, &nothing, NULL),
            "the bodies of this world were given as arrays; expected mane_move_body");
    REFUSED(mane_advance(NULL), "world is NULL");
    CHECK(mane_state_hash(NULL) == 0);
    mane_destroy(world);
    mane_destroy(twin);
    mane_destroy(NULL);
}

static void test_fields(void) {
    mane_world* world = make_world(1);
    double numbers[3] = {0, 0, 0};
    size_t count = 0;
    CHECK(mane_get_numbers(world, "skeleton.bending_length", numbers, 3, &count) == MANE_OK);
    CHECK(count == 1 && fabs(numbers[0] - 0.06) < 1e-8);
    CHECK(mane_set_text(world, "skeleton.bending_length", "7.5 cm") == MANE_OK);
    CHECK(mane_get_numbers(world, "skeleton.bending_length", numbers, 3, &count) == MANE_OK);
    CHECK(fabs(numbers[0] - 0.075) < 1e-8);
    const double ramp[] = {1, 0.5};
    CHECK(mane_set_numbers(world, "envelope.stiffness", ramp, 2) == MANE_OK);
    CHECK(mane_get_numbers(world, "envelope.stiffness", numbers, 3, &count) == MANE_OK);
    CHECK(count == 2 && numbers[1] == 0.5);
    CHECK(mane_get_numbers(world, "air.wind", NULL, 0, &count) == MANE_OK && count == 3);
    const double off = 0;
    CHECK(mane_set_numbers(world, "schedule.hold_contacts", &off, 1) == MANE_OK);
    CHECK(mane_set_text(world, "schedule.hold_contacts", "true") == MANE_OK);

    char text[32];
    size_t length = 0;
    CHECK(mane_set_text(world, "wisps.mode", "isotropic") == MANE_OK);
    CHECK(mane_get_text(world, "wisps.mode", text, sizeof text, &length) == MANE_OK);
    CHECK(strcmp(text, "isotropic") == 0 && length == 9);
    CHECK(mane_get_text(world, "wisps.mode", text, 4, &length) == MANE_OK);
    CHECK(strcmp(text, "iso") == 0 && length == 9);
    CHECK(mane_get_text(world, "air.wind", text, sizeof text, &length) == MANE_OK);
    CHECK(strcmp(text, "[1.0, 0.0, 0.0]") == 0);

    const uint64_t hash = mane_state_hash(world);
    const double two = 2;
    REFUSED(mane_set_numbers(world, "wisps.frition", &two, 1),
            "no field wisps.frition (did you mean wisps.friction?)");
    REFUSED(mane_set_numbers(world, "skeleton.strain", &two, 1),
            "setting: skeleton.strain: found 2, expected a number from 0.0001 to 0.2");
    REFUSED(mane_set_numbers(world, "envelope.points", &two, 1),
            "setting: envelope.points: found 2, expected a whole number from 3 to 8");
    REFUSED(mane_set_text(world, "envelope.points", "5"),
            "envelope.points: found 5, expected 4: it is fixed while a world runs");
    REFUSED(mane_set_text(world, "style.radius", "2 cm"),
            "style.radius: this world's hair was given as curves, not laid by a style");
    REFUSED(mane_get_numbers(world, "wisps.mode", numbers, 3, &count),
            "wisps.mode is text; expected a field of numbers");
    REFUSED(mane_set_text(world, NULL, "1"), "key is NULL");
    /* all or none */
    const double gravity[] = {0, -1, 0};
    const mane_setting both[] = {{"simulation.gravity", NULL, gravity, 3},
                                 {"skeleton.strain", "0.0001", NULL, 0}};
    CHECK(mane_set(world, both, 2) == MANE_INPUT_ERROR);
    CHECK(strstr(mane_last_error(), "unstable") != NULL);
    CHECK(mane_get_numbers(world, "simulation.gravity", numbers, 3, &count) == MANE_OK);
    CHECK(fabs(numbers[1] + 9.81) < 1e-6);
    CHECK(mane_state_hash(world) == hash);

    int live = 0;
    for (size_t i = 0; i < mane_field_count(); ++i) {
        mane_field field = {.size = sizeof field};
        CHECK(mane_get_field(i, &field) == MANE_OK);
        CHECK(strchr(field.key, '.') && strlen(field.help) > 10);
        live += field.live;
        if (strcmp(field.key, "skeleton.strain") == 0)
            CHECK(field.live && field.low == 1e-4 && field.high == 0.2 && field.unit[0] == '1');
    }
    CHECK(live > 50);
    mane_field none = {.size = sizeof none};
    CHECK(mane_get_field(mane_field_count(), &none) == MANE_INPUT_ERROR);
    mane_destroy(world);
}

static void test_pins(void) {
    mane_world* world = make_world(1);
    mane_pin pin = {.size = sizeof pin, .section = SECTIONS - 1, .has_place = 1};
    pin.place[0] = 0.1, pin.place[1] = -0.15, pin.place[2] = 0;
    CHECK(mane_hold(world, &pin) == MANE_OK);
    for (int i = 0; i < 4; ++i)
        CHECK(mane_advance(world) == MANE_OK);
    const mane_frame now = frame_of(world);
    for (int c = 0; c < 3; ++c)
        CHECK(fabs(now.origin[c] + (double)now.position[3 * (SECTIONS - 1) + c] - pin.place[c]) <
              1e-7);
    CHECK(mane_release(world, SECTIONS - 1) == MANE_OK);
    REFUSED(mane_release(world, SECTIONS - 1), "release of section 7: it is not pinned");
    pin.section = 0;
    CHECK(mane_hold(world, &pin) == MANE_INPUT_ERROR);
    pin = (mane_pin){.size = sizeof pin, .section = 5, .follows = 1};
    CHECK(mane_hold(world, &pin) == MANE_OK);
    CHECK(mane_advance(world) == MANE_OK);
    mane_destroy(world);
}

static void test_strands(void) {
    mane_world* world = make_world(2);
    size_t strands = 0, vertices = 0, first = 0, end = 0;
    float dummy;
    REFUSED(mane_fill_strands(world, 0, 1, &dummy, &dummy, 1),
            "no strands yet; expected mane_begin_strands");
    CHECK(mane_begin_strands(world, 4, &strands, &vertices) == MANE_OK && strands == 500);
    CHECK(mane_first_vertex(world, strands, &end) == MANE_OK && end == vertices);
    float* all = malloc(3 * vertices * sizeof *all);
    float* widths = malloc(vertices * sizeof *widths);
    CHECK(all && widths);
    CHECK(mane_advance(world) == MANE_OK);
    CHECK(mane_fill_strands(world, 0, strands, all, widths, vertices) == MANE_OK);
    /* one alone is the one of all */
    CHECK(mane_first_vertex(world, 123, &first) == MANE_OK);
    CHECK(mane_first_vertex(world, 124, &end) == MANE_OK);
    float alone[3 * 64], width[64];
    CHECK(end - first <= 64);
    CHECK(mane_fill_strands(world, 123, 1, alone, width, 64) == MANE_OK);
    CHECK(memcmp(alone, all + 3 * first, 3 * (end - first) * sizeof *all) == 0);
    CHECK(memcmp(width, widths + first, (end - first) * sizeof *widths) == 0);
    CHECK(mane_fill_strands(world, 0, strands, all, widths, vertices - 1) == MANE_INPUT_ERROR);
    CHECK(mane_fill_strands(world, 499, 2, all, widths, vertices) == MANE_INPUT_ERROR);
    /* a drawn field changes them at once, the hair does not move */
    const uint64_t hash = mane_state_hash(world);
    CHECK(mane_set_text(world, "strands.root_width", "0.2 mm") == MANE_OK);
    CHECK(mane_fill_strands(world, 123, 1, alone, width, 64) == MANE_OK);
    CHECK(width[0] > 1.9e-4f && mane_state_hash(world) == hash);
    free(all);
    free(widths);
    mane_destroy(world);
}

#ifdef HAS_FORMATS
static void test_scenes(void) {
    mane_world *world = NULL, *moved = NULL;
    const char* text = "[style]\nwisps = 12\nsegments = 6\n[motion]\nshake = 20\n";
    CHECK(mane_create_from_scene_text(text, NULL, NULL, &world) == MANE_OK);
    mane_options options = {.size = sizeof options, .scene_motion = 1};
    CHECK(mane_create_from_scene_text(text, ".", &options, &moved) == MANE_OK);
    mane_pose head;
    CHECK(mane_head(world, &head) == MANE_OK && head.position[1] > 1.4 && head.rotation[3] == 1);
    head.position[0] += 0.01;
    const double chest[] = {0, 0.05, 0, 1};
    CHECK(mane_move_head(world, &head, chest) == MANE_OK);
    for (int i = 0; i < 3; ++i) {
        CHECK(mane_advance(world) == MANE_OK);
        CHECK(mane_advance(moved) == MANE_OK);
    }
    CHECK(mane_state_hash(world) != mane_state_hash(moved));
    CHECK(mane_set_text(world, "style.radius", "2.6 cm") == MANE_OK);
    CHECK(mane_set_text(world, "schedule.integration_rate", "1200") == MANE_OK);
    CHECK(mane_advance(world) == MANE_OK);
    const mane_pose by = {{0, 0, 3}, {0, 0, 0, 1}};
    CHECK(mane_teleport(world, &by) == MANE_OK);
    CHECK(mane_head(world, &head) == MANE_OK && fabs(head.position[2] - 3) < 0.2);
    REFUSED(mane_move_head(moved, &head, NULL),
            "the head of this world moves as its scene says (scene_motion)");
    CHECK(mane_create_from_scene_text("[style]\nwips = 3\n", NULL, NULL, &moved) ==
          MANE_INPUT_ERROR);
    CHECK(strstr(mane_last_error(), "wips") != NULL);
    mane_world* none = NULL;
    CHECK(mane_create_from_scene_file("no such file.toml", NULL, &none) == MANE_INPUT_ERROR);
    CHECK(strstr(mane_last_error(), "no such file.toml") != NULL && none == NULL);
    mane_destroy(world);
    mane_destroy(moved);
}
#endif

int main(void) {
    CHECK(strlen(mane_version()) >= 5);
    test_running();
    test_fields();
    test_pins();
    test_strands();
#ifdef HAS_FORMATS
    test_scenes();
#endif
    puts("script test passed");
    return 0;
}
