#include "passes/filters/lobes/clustering.h"

#include <stdio.h>
#include <string.h>

#include <cglm/cglm.h>

#include "passes/context/camera.h"
#include "passes/maps/colours/mirrored_luminance.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/seen_tiles.h"
#include "passes/maps/surface_atlas.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/clustering_atlas.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/mixture.h"

static uint32_t layers_of(uint32_t subdivision) {
    static const uint32_t layers[] = {1, 5, 13};
    return layers[subdivision];
}

static void read_atlas(lobe_pass *pass, const surface_atlas *atlas) {
    lobe_pass_read(pass, &(lobe_binding){.name = "atlas_normal", .resource = atlas->normal});
    lobe_pass_read(pass, &(lobe_binding){.name = "atlas_tangent", .resource = atlas->tangent});
    lobe_pass_read(pass, &(lobe_binding){.name = "atlas_position", .resource = atlas->position});
}

/// In camera space: the rotation from object to camera, and the eye in object space.
static void camera_constants(const filter_context *context, size_t instance, bool double_sided,
                             struct atlas_constants *constants) {
    mat4 object_to_world, world_to_object;
    memcpy(object_to_world, context->scene->scene->instances[instance].transform,
           sizeof object_to_world);
    glm_mat4_inv(object_to_world, world_to_object);
    mat3 linear, world_to_camera, rotation;
    glm_mat4_pick3(object_to_world, linear);
    passes_camera_rotation(context->view.camera, world_to_camera);
    glm_mat3_mul(world_to_camera, linear, rotation);
    // A rotation times a uniform scale has rows of equal length.
    float scale = glm_vec3_norm(linear[0]);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            constants->rotation[row][column] = scale > 0 ? rotation[column][row] / scale : 0;
    }
    vec4 eye, object_eye;
    passes_camera_eye(context->view.camera, eye);
    glm_mat4_mulv(world_to_object, eye, object_eye);
    // Nothing faces away on a double-sided surface.
    if (double_sided)
        object_eye[3] = -1;
    memcpy(constants->eye, object_eye, sizeof object_eye);
}

static void object_constants(struct atlas_constants *constants) {
    for (int row = 0; row < 3; row++)
        constants->rotation[row][row] = 1;
    constants->eye[3] = -1;
}

mixture_map passes_lobe_clustering(const filter_context *context, size_t instance,
                                   const mixture_request *request) {
    const lobe_map_space space = request->space;
    const device_instance *drawn = &context->scene->instances[instance];
    const device_material *material = &context->scene->materials[drawn->material];
    const lobe_grid grid = passes_lobe_grid(material);

    mixture_map mixture = {.format = passes_filtered_map_format(context),
                           .subdivision = request->subdivision,
                           .space = space,
                           .weighted = passes_mirrored_luminance_varies(material),
                           .width_colours = request->width_colours};
    uint32_t layers = layers_of(request->subdivision);
    mixture.mean_layer = request->mean ? layers++ : 0;
    if (mixture.weighted && (space != LOBE_SPACE_TANGENT || passes_lobes_are_masked(material)))
        mixture.kept_layer = layers++;
    mixture.width_layer = request->widths ? layers : 0;
    layers += request->widths ? 1 + request->subdivision + request->width_colours : 0;
    char name[64];
    if (space == LOBE_SPACE_TANGENT)
        snprintf(name, sizeof name, "mixture of material %u", drawn->material);
    else
        snprintf(name, sizeof name, "mixture of instance %zu", instance);
    mixture.map =
        space == LOBE_SPACE_TANGENT
            ? passes_seen_map_declare(context, drawn->material, name, mixture.format, layers, true)
            : passes_reduced_map_declare(context->graph, name, mixture.format, grid.width,
                                         grid.height, layers, true);

    surface_atlas atlas = {0};
    if (space != LOBE_SPACE_TANGENT)
        atlas = passes_surface_atlas_draw(context, instance, grid.width, grid.height);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "lobe_clustering");
    passes_base_maps_read(context, material, mixture.weighted, pass);
    passes_base_colour_read(context, material, mixture.weighted, pass);
    passes_reduced_map_write(&mixture.map, pass, "mixture_map", 0);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    passes_specialise(&list, SPECIALISE_SUBDIVISION, request->subdivision);
    passes_specialise(&list, SPECIALISE_CLUSTERS, request->clusters);
    passes_specialise(&list, SPECIALISE_MEAN_LAYER, mixture.mean_layer);
    passes_specialise(&list, SPECIALISE_WEIGHTED, mixture.weighted);
    passes_specialise(&list, SPECIALISE_KEPT_LAYER, mixture.kept_layer);
    passes_specialise(&list, SPECIALISE_WIDTH_LAYER, mixture.width_layer);
    passes_specialise(&list, SPECIALISE_WIDTH_COLOURS, mixture.width_colours);
    const struct lobe_grid_constants tangent_constants =
        passes_lobe_grid_constants(context, material);
    if (mixture.weighted)
        passes_colour_square_specialise(material, &tangent_constants,
                                        passes_base_maps_are_interpolated(material), &list);
    struct atlas_constants atlas_constants = {.width = grid.width,
                                              .height = grid.height,
                                              .alpha = tangent_constants.alpha,
                                              .cutoff = tangent_constants.cutoff};
    lobe_dispatch dispatch = {
        .shader = mixture.map.tiles.version > 0 ? "filters/lobes/clustering_seen_tiles.comp"
                                                : "filters/lobes/clustering.comp",
        .constants = &tangent_constants,
        .constants_size = sizeof tangent_constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
    };
    if (space != LOBE_SPACE_TANGENT) {
        read_atlas(pass, &atlas);
        if (space == LOBE_SPACE_CAMERA)
            camera_constants(context, instance, material->material->double_sided, &atlas_constants);
        else
            object_constants(&atlas_constants);
        dispatch.shader = "filters/lobes/clustering_atlas.comp";
        dispatch.constants = &atlas_constants;
        dispatch.constants_size = sizeof atlas_constants;
    }
    passes_reduced_map_dispatch(&mixture.map, pass, 0, 1, &dispatch);
    return mixture;
}
