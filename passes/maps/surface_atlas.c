#include "passes/maps/surface_atlas.h"

#include <stdio.h>
#include <string.h>

#include "passes/upload/device_mesh.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/atlas.h"

static lobe_resource declare(lobe_graph *graph, const char *what, size_t instance, uint32_t width,
                             uint32_t height) {
    char name[64];
    snprintf(name, sizeof name, "atlas %s %zu", what, instance);
    return lobe_graph_image(graph, &(lobe_image_description){.name = name,
                                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                             .width = width,
                                                             .height = height,
                                                             .retained = true,
                                                             .shared = true});
}

static struct atlas_layout layout_of(const device_material *material) {
    const lobe_texture_use *use = passes_lobe_grid(material).use;
    struct atlas_layout layout = {.second_coordinates = use->texture_coordinates};
    memcpy(layout.u, use->transform[0], sizeof use->transform[0]);
    memcpy(layout.v, use->transform[1], sizeof use->transform[1]);
    return layout;
}

surface_atlas passes_surface_atlas_draw(const filter_context *context, size_t instance,
                                        uint32_t width, uint32_t height) {
    lobe_graph *graph = context->graph;
    const device_instance *drawn = &context->scene->instances[instance];
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_RASTER, "surface_atlas");
    lobe_attachment attachments[3] = {
        {.resource = declare(graph, "normal", instance, width, height)},
        {.resource = declare(graph, "tangent", instance, width, height)},
        {.resource = declare(graph, "position", instance, width, height)},
    };
    lobe_resource written[3];
    for (uint32_t i = 0; i < 3; i++)
        written[i] = lobe_pass_colour(pass, i, &attachments[i]);
    struct atlas_layout layout = layout_of(&context->scene->materials[drawn->material]);
    lobe_binding vertices = {.name = "vertex_block",
                             .resource =
                                 passes_device_mesh_import(graph, context->scene, drawn->mesh)};
    lobe_pass_draw(
        pass, &(lobe_draw){
                  .vertex_shader = "maps/surface_atlas.vert",
                  .fragment_shader = "maps/surface_atlas.frag",
                  .indices = lobe_graph_import_buffer(graph, context->scene->indices[drawn->mesh]),
                  .index_count = (uint32_t)context->scene->scene->meshes[drawn->mesh].index_count,
                  .constants = &layout,
                  .constants_size = sizeof layout,
                  .bindings = &vertices,
                  .binding_count = 1,
              });
    return (surface_atlas){written[0], written[1], written[2]};
}
