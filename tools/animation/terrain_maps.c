#include "tools/animation/terrain_maps.h"

#include <string.h>

#include "tools/scenes/outdoors/terrain_scene.h"

static bool find_image(const lobe_scene *scene, const char *name, uint32_t *index) {
    for (size_t i = 0; i < scene->image_count; i++)
        if (scene->images[i].on_device && strcmp(scene->images[i].name, name) == 0) {
            *index = (uint32_t)i;
            return true;
        }
    return false;
}

bool terrain_maps_find(const lobe_scene *scene, terrain_maps *maps) {
    const bool found = find_image(scene, TERRAIN_HEIGHTS, &maps->heights) &&
                       find_image(scene, TERRAIN_NORMALS, &maps->normals);
    maps->texels = found ? scene->images[maps->heights].image.width : 0;
    return found;
}

static lobe_resource write_image(lobe_graph *graph, lobe_pass *pass, const char *name,
                                 lobe_format format, uint32_t texels) {
    const lobe_image_description description = {
        .name = name, .format = format, .width = texels, .height = texels, .retained = true};
    return lobe_pass_write(
        pass, &(lobe_binding){.name = "texels", .resource = lobe_graph_image(graph, &description)});
}

void terrain_maps_give(const terrain_maps *maps, lobe_graph *graph, lobe_resource *images) {
    const float factor = (float)(TERRAIN_RELIEF * maps->texels); // of a texel's width
    lobe_dispatch dispatch = {.shader = "terrain_heights.comp",
                              .threads = {maps->texels, maps->texels}};
    lobe_pass *heights = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "terrain_heights");
    images[maps->heights] =
        write_image(graph, heights, TERRAIN_HEIGHTS, LOBE_FORMAT_R32_FLOAT, maps->texels);
    lobe_pass_dispatch(heights, &dispatch);
    lobe_pass *normals = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "terrain_normals");
    lobe_pass_read(normals, &(lobe_binding){.name = "heights", .resource = images[maps->heights]});
    images[maps->normals] =
        write_image(graph, normals, TERRAIN_NORMALS, LOBE_FORMAT_RG16_FLOAT, maps->texels);
    dispatch.shader = "terrain_normals.comp";
    dispatch.constants = &factor;
    dispatch.constants_size = sizeof factor;
    lobe_pass_dispatch(normals, &dispatch);
}
