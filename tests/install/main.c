/* The installed C interface, seen by a C compiler. */
#include <mane/mane.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    mane_world* world = NULL;
    if (mane_create(NULL, 0, NULL, NULL, 0, NULL, &world) != MANE_INPUT_ERROR || world)
        return 1;
    printf("mane %s: %s\n", mane_version(), mane_last_error());
#ifdef HAS_FORMATS
    if (mane_create_from_scene_text("[style]\nwisps = 8\n", NULL, NULL, &world) != MANE_OK ||
        mane_advance(world) != MANE_OK || mane_state_hash(world) == 0)
        return puts(mane_last_error()), 1;
    mane_destroy(world);
#endif
    return mane_field_count() > 50 ? 0 : 1;
}
