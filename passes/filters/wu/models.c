#include "passes/filters/wu/models.h"

/// What Vulkan asks of every device: buffers of 128 MiB.
bool passes_wu_fits(const device_material *material) {
    const uint64_t largest = (uint64_t)1 << 27;
    const device_map *map = &material->maps[MAP_HEIGHT];
    const uint64_t texels = (uint64_t)map->width * map->height;
    return texels * sizeof(struct wu_cell) / 64 * 4 / 3 <= largest;
}

static void fail_size(const filter_context *context, const device_material *material) {
    const device_map *map = &material->maps[MAP_HEIGHT];
    lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                    "%s: a height map of %u x %u texels is too large for filter '%s': it has more "
                    "than 26 million",
                    material->material->name, map->width, map->height,
                    lobe_filter_name(context->filter));
}

uint32_t passes_wu_part_count(const device_material *material, const wu_kind *kind) {
    const device_map *map = &material->maps[MAP_HEIGHT];
    struct wu_constants constants = {0};
    passes_wu_place_levels(map->width, map->height, kind, &constants);
    return 1 + constants.level_count;
}

/// What the parts so far have made, although nothing reads it in this frame.
static void keep_parts(const wu_build *build, bool mirrors, bool has_levels) {
    lobe_graph_output(build->graph, build->direct);
    lobe_graph_output(build->graph, build->indirect);
    lobe_graph_output(build->graph, build->models.whole);
    if (mirrors) {
        lobe_graph_output(build->graph, build->vertices);
        lobe_graph_output(build->graph, build->first);
    }
    if (has_levels) {
        lobe_graph_output(build->graph, build->models.cells);
        lobe_graph_output(build->graph, build->models.ratios);
    }
}

wu_models passes_wu_models(const filter_context *context, uint32_t index, const wu_kind *kind,
                           uint32_t parts, bool in_parts) {
    if (!passes_wu_fits(&context->scene->materials[index])) {
        fail_size(context, &context->scene->materials[index]);
        return (wu_models){0};
    }
    wu_build build = passes_wu_begin(context, index, kind, in_parts);
    if (parts == 0)
        return build.models;
    passes_wu_add_paths(&build);
    const uint32_t levels = build.models.constants.level_count;
    const uint32_t count = parts - 1 < levels ? parts - 1 : levels;
    for (uint32_t level = 0; level < count; level++) {
        const relief low = passes_wu_add_low_relief(&build, level);
        passes_wu_add_cells(&build, level, &low);
        passes_wu_add_scaling(&build, level);
        if (kind->mirrors)
            passes_wu_add_mirrors(&build, level);
    }
    if (in_parts)
        keep_parts(&build, kind->mirrors, count > 0);
    return build.models;
}
