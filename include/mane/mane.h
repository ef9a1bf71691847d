#ifndef MANE_MANE_H
#define MANE_MANE_H

/* The flat C interface of mane, for engines and other languages: C99, no exceptions, no C++ types.
 *
 * Units are SI: metres, kilograms, seconds. Right-handed axes, Y up, the character faces +Z.
 * Quaternions are x, y, z, w with the scalar part last, of any length but zero.
 *
 * Every function that can fail returns a `mane_result`; whatever fails leaves the world as it was
 * (but for a simulation that became non-finite), and `mane_last_error` says why. Structs that are
 * passed in or filled begin with their size, `sizeof` as the caller knows it, so that later
 * versions can add members at the end: members beyond a caller's size have their default, which
 * is 0.
 *
 * One world is for one thread at a time; different worlds may run in different threads. What a
 * world computes does not depend on its number of threads, nor on the machine.
 *
 * In libmane; the functions of scenes are in libmane_formats. */

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define MANE_API __attribute__((visibility("default")))
#else
#define MANE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mane_result {
    MANE_OK = 0,
    MANE_INPUT_ERROR = 1,      /* something given cannot be used */
    MANE_SIMULATION_ERROR = 2, /* the state became non-finite: the world is of no more use */
    MANE_OUT_OF_MEMORY = 3,
    MANE_INTERNAL_ERROR = 4 /* a bug of mane's */
} mane_result;

/* Why the last call in this thread that failed did so. Valid until the next one fails. */
MANE_API const char* mane_last_error(void);
/* "0.1.0" */
MANE_API const char* mane_version(void);

/* ---- making a world ---- */

typedef struct mane_world mane_world;

/* How a world runs. NULL or zeroes: one thread, the machine's best instruction set, from time 0. */
typedef struct mane_options {
    size_t size;
    uint32_t threads;            /* 0: one. MANE_ALL_THREADS: as many as the machine has */
    const char* instruction_set; /* NULL: the best; else avx512, avx2, sse4, scalar. Same bits */
    double start_time;           /* [s] of frame 0 */
    int32_t scene_motion;        /* of a scene: 0: the host leads the head; 1: as the scene says */
} mane_options;
#define MANE_ALL_THREADS UINT32_MAX

/* A field of the table (`mane help scene`) and its value: numbers, or text. */
typedef struct mane_setting {
    const char* key;       /* such as "skeleton.strain" */
    const char* text;      /* such as "0.5 cm", "anisotropic", "true"; NULL: numbers */
    const double* numbers; /* in the field's unit; 1, or 2 of a ramp, or 3 of a vector */
    size_t count;
} mane_setting;

/* A closed surface made of triangles, counter-clockwise seen from outside, that the hair touches.
 * The first of a world wears the hair. */
typedef struct mane_body {
    size_t size;
    const char* name;      /* for messages; may be NULL */
    const float* vertices; /* [m] 3 per vertex, in the rest pose */
    size_t vertex_count;
    const uint32_t* triangles; /* 3 vertices per triangle */
    size_t triangle_count;
    const uint16_t* skin_bones; /* 4 per vertex; NULL: all follow bone 0 */
    const float* skin_weights;  /* 4 per vertex, sum 1; NULL with the above */
    size_t bone_count;          /* 0: 1 */
    uint32_t head_bone;         /* of the first body: the bone that carries the hair */
    int32_t worn;               /* 1: a hat, which wisps may start inside of */
} mane_body;

/* Hair as designed, in the first body's rest pose: per wisp a curve with cross-sections. Gravity
 * and springs are put in balance in this shape. Section 0 of a wisp is inside the head, section 1
 * just outside the skin; both ride the skin. */
typedef struct mane_hair {
    size_t size;
    size_t wisp_count;
    const uint32_t* first_section; /* wisp_count + 1: where each wisp's sections begin */
    const float* position;         /* [m] 3 per section */
    const float* radius;           /* [m] "envelope.points" per section, along its half lines */
    const uint32_t* triangle;      /* per wisp: of the first body, where it is rooted */
    const float* barycentric;      /* 3 per wisp: the root in that triangle, sum 1 */
    const float* first_axis;       /* 3 per wisp: unit, across it: its first half line */
    const uint32_t* strands;       /* per wisp; NULL: "strands.count" shared evenly */
} mane_hair;

/* A world from arrays, which are copied. Bodies rest in their rest pose until they are moved. */
MANE_API mane_result mane_create(const mane_body* bodies, size_t body_count, const mane_hair* hair,
                                 const mane_setting* settings, size_t setting_count,
                                 const mane_options* options, mane_world** world);
/* A world from a scene file (TOML), or from its text: relative names in it start at `folder`. In
 * libmane_formats. The character is a bust of three bones, led by its head. */
MANE_API mane_result mane_create_from_scene_file(const char* path, const mane_options* options,
                                                 mane_world** world);
MANE_API mane_result mane_create_from_scene_text(const char* text, const char* folder,
                                                 const mane_options* options, mane_world** world);
/* NULL is allowed. */
MANE_API void mane_destroy(mane_world* world);

/* ---- running it ---- */

/* Where something is: its rest point p is at rotation(p) + position. */
typedef struct mane_pose {
    double position[3]; /* [m] */
    double rotation[4];
} mane_pose;

/* Simulates until the next frame. */
MANE_API mane_result mane_advance(mane_world* world);

/* Where the head of a scene's character is to be at the next frame: `position` is that of the
 * head's joint, where the skull sits on the neck. `chest`: how the shoulders are turned; NULL: not.
 * The way between frames is C², however jerky the poses (mane/driven.h). A head that is not led
 * comes to rest where it is. */
MANE_API mane_result mane_move_head(mane_world* world, const mane_pose* head, const double* chest);
/* Where the head was led to last; at first, where it rests. */
MANE_API mane_result mane_head(const mane_world* world, mane_pose* head);
/* Where all bones of a body that was given as arrays are to be at the next frame. */
MANE_API mane_result mane_move_body(mane_world* world, size_t body, const mane_pose* bones,
                                    size_t bone_count);
/* Takes the character, what it wears and the hair elsewhere at once, without a shock: what was at
 * p is at rotation(p) + position, moving as before. */
MANE_API mane_result mane_teleport(mane_world* world, const mane_pose* by);

/* A section that is held, exactly: it goes to its place smoothly, from where and as it moves. */
typedef struct mane_pin {
    size_t size;
    uint32_t section;
    int32_t has_place; /* 0: where the section is now */
    double place[3];   /* [m] in the world or, on a body, in its rest pose */
    int32_t follows;   /* 1: it follows a bone of `body`; 0: it stays in the world */
    uint32_t body, bone;
    double ease; /* [s] until it is there; 0: a tenth of a second */
} mane_pin;
MANE_API mane_result mane_hold(mane_world* world, const mane_pin* pin);
MANE_API mane_result mane_release(mane_world* world, uint32_t section);

/* ---- parameters: the fields of the table, by key ---- */

typedef struct mane_field {
    size_t size;
    const char* key;  /* valid as long as the program runs, as all text here */
    const char* unit; /* "" of switches, choices and text */
    const char* help;
    double low, high; /* of each number */
    int32_t live;     /* 1: may change while a world runs */
} mane_field;
MANE_API size_t mane_field_count(void);
MANE_API mane_result mane_get_field(size_t index, mane_field* field);

/* Changes a live field of a running world. Text is as in a scene: "6 cm", "anisotropic", "true". */
MANE_API mane_result mane_set_text(mane_world* world, const char* key, const char* text);
/* Numbers in the field's unit; switches are 0 and 1. */
MANE_API mane_result mane_set_numbers(mane_world* world, const char* key, const double* numbers,
                                      size_t count);
/* Several fields at once: all of them or none. */
MANE_API mane_result mane_set(mane_world* world, const mane_setting* settings, size_t count);
/* `count`: how many numbers the field has, of which at most `capacity` are written. */
MANE_API mane_result mane_get_numbers(const mane_world* world, const char* key, double* numbers,
                                      size_t capacity, size_t* count);
/* `length`: that of the text without its end, of which `capacity` − 1 characters are written. */
MANE_API mane_result mane_get_text(const mane_world* world, const char* key, char* text,
                                   size_t capacity, size_t* length);

/* ---- reading it ---- */

/* The hair now: the world's own memory. Addresses stay valid and the same as long as the world
 * lives; what is there changes with `mane_advance` and `mane_teleport`. */
typedef struct mane_frame {
    size_t size;
    uint32_t index;
    uint32_t envelope_points; /* K */
    double time;              /* [s] */
    double next_time;         /* [s] of the next frame */
    double origin[3];         /* [m] in the world: positions are relative to it */
    size_t wisp_count, section_count;
    const uint32_t* first_section; /* wisp_count + 1 */
    const float* position;         /* [m] 3 per section */
    const float* velocity;         /* [m/s] 3 per section */
    const float* first_axis;       /* 3 per wisp */
    const float* radius;           /* [m] K per section */
    const float* radius_rate;      /* [m/s] K per section */
} mane_frame;
MANE_API mane_result mane_get_frame(const mane_world* world, mane_frame* frame);
/* Vertices of a body now [m], 3 per vertex, relative to the frame's origin; likewise. */
MANE_API mane_result mane_body_vertices(const mane_world* world, size_t body,
                                        const float** vertices, size_t* vertex_count);

/* Strands for drawing, into the caller's memory. First how many there are, with this many pieces
 * per segment: it stays so until "strands.count" changes. */
MANE_API mane_result mane_begin_strands(mane_world* world, uint32_t samples_per_segment,
                                        size_t* strand_count, size_t* vertex_count);
/* Index of a strand's first vertex; of strand_count: the number of all vertices. */
MANE_API mane_result mane_first_vertex(const mane_world* world, size_t strand, size_t* vertex);
/* Fills the vertices of strands first … first + count − 1 of the present frame, root to tip, one
 * strand after the other: `positions` [m] 3 per vertex, relative to the frame's origin, `widths`
 * [m] 1 per vertex. `vertex_count`: how many there is room for. */
MANE_API mane_result mane_fill_strands(mane_world* world, size_t first, size_t count,
                                       float* positions, float* widths, size_t vertex_count);

typedef struct mane_statistics {
    size_t size;
    double forces_seconds, wisp_detection_seconds, character_detection_seconds;
    double velocities_seconds, positions_seconds;
    uint64_t steps, wisp_detections, character_detections;
    uint64_t intersections, friction_contacts, collision_contacts, sliding_contacts;
    uint64_t penetration_reactions;
    uint64_t intersection_counts; /* at the first wisp detection of every frame */
} mane_statistics;
MANE_API mane_result mane_get_statistics(const mane_world* world, mane_statistics* statistics);
/* A hash over every bit of the hair's state: the same on every machine. 0 for NULL. */
MANE_API uint64_t mane_state_hash(const mane_world* world);

#ifdef __cplusplus
}
#endif

#endif
