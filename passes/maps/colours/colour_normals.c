#include "passes/maps/colours/colour_normals.h"

#include "passes/maps/base_maps.h"
#include "passes/upload/colours/colour_correlation.h"
#include "shaders/interface/material.h"

bool passes_has_colour_normals(const filter_context *context, uint32_t index) {
    return !context->filter->reads_heights &&
           passes_colours_follow_normals(context->scene, &context->scene->materials[index]);
}

reduced_map passes_colour_normals(const filter_context *context, uint32_t index) {
    const lobe_map_kind kind = {
        .content = "normals of colours",
        .pass = "colour_normals",
        .shader = "maps/colour_normals.comp",
        .seen_shader = "maps/colour_normals_seen_tiles.comp",
        .binding = "colour_normal_map",
        .layers = COLOUR_NORMALS_LAYERS,
        .reads_base_colour = true,
    };
    return passes_lobe_map(context, index, &kind, LOBE_FORMAT_RGBA16_FLOAT);
}
