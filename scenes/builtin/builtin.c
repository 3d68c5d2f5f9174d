#include "scenes/builtin/builtin.h"

#include <string.h>

static const builtin_scene table[] = {
    {{"checkerboard", "a plane of two lobe widths in fine squares, seen into the distance"},
     scenes_builtin_checkerboard},
    {{"bumps", "a plane of hemispherical bumps, each of its own metal and roughness"},
     scenes_builtin_bumps},
    {{"tablecloth", "a draped cloth with two lobes at 45 degrees and a noise normal map"},
     scenes_builtin_tablecloth},
    {{"pillow", "a cushion of brocade, woven of sharp silk one way and broad gold the other"},
     scenes_builtin_pillow},
    {{"hall", "a colonnade of five materials: wet floor, masonry, marble, bronze and banners"},
     scenes_builtin_hall},
};

size_t lobe_builtin_scene_count(void) {
    return sizeof table / sizeof table[0];
}

const lobe_builtin_scene *lobe_builtin_scene_get(size_t index) {
    return index < lobe_builtin_scene_count() ? &table[index].description : NULL;
}

const builtin_scene *scenes_builtin_find(const char *name) {
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++)
        if (strcmp(table[i].description.name, name) == 0)
            return &table[i];
    return NULL;
}
