#ifndef SCENES_BUILTIN_H
#define SCENES_BUILTIN_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Scenes made by code. Each is one file, scenes/builtin/<name>.c, and one row of the table in
/// scenes/builtin/builtin.c. Their only source of randomness is scenes/builtin/random.h, and they
/// use only those functions of libm that IEEE 754 defines to the last bit (sqrt, floor, fmin), so
/// that every machine makes the same bytes.

typedef struct builtin_scene {
    lobe_builtin_scene description;
    /// Makes a completed scene. On failure `*scene` is NULL.
    lobe_result (*build)(const lobe_host *host, lobe_scene **scene);
} builtin_scene;

/// NULL if no scene has that name, which is not an error: nothing is logged.
const builtin_scene *scenes_builtin_find(const char *name);

lobe_result scenes_builtin_checkerboard(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_bumps(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_tablecloth(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_pillow(const lobe_host *host, lobe_scene **scene);
lobe_result scenes_builtin_hall(const lobe_host *host, lobe_scene **scene);

#endif
