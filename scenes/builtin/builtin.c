#include "scenes/builtin/builtin.h"

#include <string.h>

#include "scenes/mesh/mesh.h"
#include "scenes/scene/scene.h"

static const builtin_scene table[] = {
    {{"checkerboard", "a plane of two lobe widths in fine squares, seen into the distance", false},
     scenes_builtin_checkerboard,
     NULL},
    {{"bumps", "a plane of hemispherical bumps, each of its own metal and roughness", false},
     scenes_builtin_bumps,
     NULL},
    {{"tablecloth", "a draped cloth with two lobes at 45 degrees and a noise normal map", false},
     scenes_builtin_tablecloth,
     NULL},
    {{"pillow", "a cushion of brocade, woven of sharp silk one way and broad gold the other",
      false},
     scenes_builtin_pillow,
     NULL},
    {{"hall", "a colonnade of five materials: wet floor, masonry, marble, bronze and banners",
      false},
     scenes_builtin_hall,
     NULL},
    {{"bunny", "a rabbit covered with bumps of metal and lacquer (its mesh is an asset)", true},
     NULL,
     scenes_builtin_bunny},
    {{"dragon", "a dragon of patinated bronze with fine scales (its mesh is an asset)", true},
     NULL,
     scenes_builtin_dragon},
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

lobe_result scenes_builtin_assemble(const char *name, const builtin_step *steps,
                                    const lobe_host *host, lobe_scene **scene) {
    *scene = NULL;
    lobe_result status = scenes_allocate(name, host, scene);
    for (; !status && *steps; steps++)
        status = (*steps)(*scene, host);
    if (!status)
        status = scenes_complete(*scene, host);
    if (status)
        lobe_scene_destroy(scene);
    return status;
}

lobe_result scenes_builtin_assemble_asset(const asset_mesh *wanted, const char *assets,
                                          const builtin_step *steps, const lobe_host *host,
                                          lobe_scene **scene) {
    lobe_mesh mesh;
    *scene = NULL;
    lobe_result status = scenes_asset_mesh_load(wanted, assets, host, &mesh);
    if (!status)
        status = scenes_allocate(wanted->scene, host, scene);
    for (; !status && *steps; steps++)
        status = (*steps)(*scene, host);
    if (!status)
        status = scenes_place_mesh(*scene, &mesh, 0, host);
    if (!status)
        status = scenes_complete(*scene, host);
    scenes_mesh_free(&mesh);
    if (status)
        lobe_scene_destroy(scene);
    return status;
}

lobe_result scenes_builtin_add_map(lobe_scene *scene, const builtin_map *map, const lobe_host *host,
                                   int32_t *index) {
    lobe_image image;
    uint32_t added;
    lobe_result status = lobe_image_allocate(&image, map->format, map->width, map->height, host);
    if (status)
        return status;
    uint8_t *texel = image.texels;
    for (uint32_t row = 0; row < map->height; row++)
        for (uint32_t column = 0; column < map->width; column++) {
            map->fill(column, row, texel);
            texel += lobe_format_size(map->format);
        }
    status = scenes_add_image(scene, map->name, &image, host, &added);
    *index = status ? -1 : (int32_t)added;
    return status;
}

lobe_result scenes_builtin_add_metal_rough(lobe_scene *scene, const char *name,
                                           const builtin_map *normals, const builtin_map *colours,
                                           const builtin_map *roughness, const lobe_host *host) {
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 1;
    lobe_result status = scenes_builtin_add_map(scene, normals, host, &material.normal_map.image);
    if (!status)
        status = scenes_builtin_add_map(scene, colours, host, &material.base_colour_map.image);
    if (!status)
        status =
            scenes_builtin_add_map(scene, roughness, host, &material.metallic_roughness_map.image);
    return status ? status : scenes_add_material(scene, name, &material, host, NULL);
}
