#include "tools/scenes/scene_list.h"

#include <string.h>

#include "tools/scenes/animated_scene.h"
#include "tools/scenes/asset_scene.h"
#include "tools/scenes/fields_scene.h"
#include "tools/scenes/flag_scene.h"
#include "tools/scenes/outdoors/ocean_scene.h"
#include "tools/scenes/outdoors/terrain_scene.h"
#include "tools/scenes/relief/relief_scenes.h"

typedef struct own_scene {
    listed_scene description;
    lobe_result (*build)(const char *assets, const lobe_host *host, lobe_scene **scene);
} own_scene;

static const own_scene own_scenes[] = {
    {{"bunny", "a rabbit covered with bumps of metal and lacquer (its mesh is an asset)", true,
      NULL},
     asset_scene_bunny},
    {{"dragon", "a dragon of patinated bronze with fine scales (its mesh is an asset)", true, NULL},
     asset_scene_dragon},
    {{"rain", "the hall, with rain on its floor: rings spread with time", false, NULL},
     animated_scene_rain},
    {{"cloth", "the tablecloth, whose weave slides and stretches with time", false, NULL},
     animated_scene_cloth},
    {{"ocean", "a sea to the horizon under a low sun; its waves move with time", false, "leadr"},
     ocean_scene},
    {{"fields", "a dome and a pyramid of metal; zoomed out, two fields of them", false, NULL},
     fields_scene},
    {{"flag", "a flag of canvas in the wind, with a relief of threads that gusts stretch", false,
      "leadr"},
     flag_scene},
    {{"twill", "a ball on a floor, both of twill in two colours; zoomed out, 64 texels to a pixel",
      false, "displaced"},
     relief_scene_twill},
    {{"cobbles", "the same of stones with dark joints", false, "displaced"}, relief_scene_cobbles},
    {{"studs", "a diffuse ball of half spheres on a floor of noise", false, "displaced"},
     relief_scene_studs},
    {{"furnace", "the same, white, in white light: what a filter loses of it is seen", false,
      "displaced"},
     relief_scene_furnace},
    {{"terrain", "mountains around a valley under sun and sky; the camera flies a loop", false,
      "leadr"},
     terrain_scene},
};
enum { OWN_SCENES = sizeof own_scenes / sizeof *own_scenes };

static const own_scene *find(const char *name) {
    for (size_t i = 0; i < OWN_SCENES; i++)
        if (strcmp(own_scenes[i].description.name, name) == 0)
            return &own_scenes[i];
    return NULL;
}

size_t scene_list_count(void) {
    return lobe_builtin_scene_count() + OWN_SCENES;
}

listed_scene scene_list_get(size_t index) {
    if (index >= lobe_builtin_scene_count())
        return own_scenes[index - lobe_builtin_scene_count()].description;
    const lobe_builtin_scene *scene = lobe_builtin_scene_get(index);
    return (listed_scene){.name = scene->name, .summary = scene->summary};
}

bool scene_list_needs_assets(const char *name) {
    const own_scene *own = find(name);
    return own && own->description.needs_assets;
}

const char *scene_list_filter(const char *name) {
    const own_scene *own = name ? find(name) : NULL;
    return own && own->description.filter ? own->description.filter : "moments";
}

lobe_result scene_list_open(const char *name, const char *assets, bool own_light_only,
                            const lobe_host *host, lobe_scene **scene) {
    const own_scene *own = find(name);
    if (own)
        return own->build(assets, host, scene);
    return lobe_scene_open_with(
        &(lobe_scene_open_parameters){.scene = name, .own_light_only = own_light_only}, host,
        scene);
}
