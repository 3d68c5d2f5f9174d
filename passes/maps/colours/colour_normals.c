#include "passes/maps/colours/colour_normals.h"

#include "passes/maps/base_maps.h"
#include "passes/upload/colours/colour_correlation.h"
#include "shaders/interface/material.h"

bool passes_has_colour_normals(const filter_context *context, uint32_t index) {
    return !context->filter->reads_heights &&
           passes_colours_follow_normals(context->scene, &context->scene->materials[index]);
}

static void read_colours(const filter_context *context, const device_material *material,
                         lobe_pass *pass, specialisation_list *list) {
    (void)list;
    passes_base_map_read(context, material, MAP_BASE_COLOUR, "base_colour_map", pass);
}

reduced_map passes_colour_normals(const filter_context *context, uint32_t index) {
    const bool masked = context->scene->materials[index].material->alpha_mask;
    const lobe_map_kind kind = {
        .content = "normals of colours",
        .pass = "colour_normals",
        .shader = "maps/colour_normals.comp",
        .seen_shader = "maps/colour_normals_seen_tiles.comp",
        .binding = "colour_normal_map",
        .layers = masked ? COLOUR_NORMALS_LAYERS : COLOUR_NORMALS_KEPT,
        .masked = masked,
        .read_more = read_colours,
    };
    return passes_lobe_map(context, index, &kind, LOBE_FORMAT_RGBA16_FLOAT);
}
