#include "scenes/builtin.h"

#include <string.h>

static const builtin_scene table[] = {
    {{"checkerboard", "a plane of two lobe widths in fine squares, seen into the distance"},
     builtin_checkerboard},
    {{"bumps", "a plane of hemispherical bumps, each of its own metal and roughness"},
     builtin_bumps},
    {{"tablecloth", "a draped cloth with two lobes at 45 degrees and a noise normal map"},
     builtin_tablecloth},
};

size_t lobe_builtin_scene_count(void) {
    return sizeof table / sizeof table[0];
}

const lobe_builtin_scene *lobe_builtin_scene_get(size_t index) {
    return index < lobe_builtin_scene_count() ? &table[index].description : NULL;
}

const builtin_scene *builtin_scene_find(const char *name) {
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++)
        if (strcmp(table[i].description.name, name) == 0)
            return &table[i];
    return NULL;
}
