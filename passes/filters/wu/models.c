#include "passes/filters/wu/models.h"

/// What Vulkan asks of every device: buffers of 128 MiB.
static bool fits(const filter_context *context, const device_material *material) {
    const uint64_t largest = (uint64_t)1 << 27;
    const device_map *map = &material->maps[MAP_HEIGHT];
    const uint64_t texels = (uint64_t)map->width * map->height;
    if (texels * sizeof(struct wu_cell) / 64 * 4 / 3 <= largest)
        return true;
    lobe_graph_fail(context->graph, LOBE_ERROR_LIMIT,
                    "%s: a height map of %u x %u texels is too large for filter '%s': it has more "
                    "than 26 million",
                    material->material->name, map->width, map->height,
                    lobe_filter_name(context->filter));
    return false;
}

wu_models passes_wu_models(const filter_context *context, uint32_t index, const wu_kind *kind) {
    if (!fits(context, &context->scene->materials[index]))
        return (wu_models){0};
    wu_build build = passes_wu_begin(context, index, kind);
    passes_wu_add_paths(&build);
    for (uint32_t level = 0; level < build.models.constants.level_count; level++) {
        const relief low = passes_wu_add_low_relief(&build, level);
        passes_wu_add_cells(&build, level, &low);
        passes_wu_add_scaling(&build, level);
        if (kind->mirrors)
            passes_wu_add_mirrors(&build, level);
    }
    return build.models;
}
