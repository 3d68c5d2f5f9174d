#include "passes/maps/colours/colour_normals.h"

#include <stddef.h>

#include "passes/maps/base_maps.h"
#include "passes/maps/colours/colour_correlation.h"
#include "shaders/interface/colours/colour_correlation.h"
#include "shaders/interface/material.h"

bool passes_has_colour_normals(const filter_context *context, uint32_t index) {
    return !context->filter->reads_heights && passes_colours_may_follow_normals(context, index);
}

reduced_map passes_colour_normals(const filter_context *context, uint32_t index) {
    const lobe_resource found = passes_colour_correlation(context, index);
    lobe_map_kind kind = {
        .content = "normals of colours",
        .pass = "colour_normals",
        .shader = "maps/colour_normals.comp",
        .seen_shader = "maps/colour_normals_seen_tiles.comp",
        .binding = "colour_normal_map",
        .layers = COLOUR_NORMALS_LAYERS,
        .reads_base_colour = true,
    };
    if (passes_colour_correlation_decides(context, index)) {
        kind.groups = found;
        kind.groups_offset = offsetof(struct colour_correlation_found, groups);
    }
    return passes_lobe_map(context, index, &kind, LOBE_FORMAT_RGBA16_FLOAT);
}
