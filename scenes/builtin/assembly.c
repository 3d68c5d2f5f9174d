#include "scenes/builtin/assembly.h"

#include <math.h>

#include "scenes/scene/scene.h"

lobe_result scenes_builtin_assemble(const char *name, const builtin_step *steps,
                                    const lobe_host *host, lobe_scene **scene) {
    *scene = NULL;
    lobe_result status = scenes_allocate(name, host, scene);
    for (; !status && *steps; steps++)
        status = (*steps)(*scene, host);
    if (!status)
        status = scenes_complete(*scene, false, host);
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

static uint8_t encode(double component) {
    return (uint8_t)floor(component * 127.5 + 128);
}

void scenes_normal_map_store(uint8_t texel[4], double x, double y, double z) {
    double length = sqrt(x * x + y * y + z * z);
    texel[0] = encode(x / length);
    texel[1] = encode(y / length);
    texel[2] = encode(z / length);
    texel[3] = 255;
}

// A height field's normal is (-dh/dx, -dh/dy, 1); rows run against y.
void scenes_normal_map_store_slope(uint8_t texel[4], double along_column, double along_row) {
    scenes_normal_map_store(texel, -along_column, along_row, 1);
}
