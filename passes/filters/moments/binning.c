#include "passes/filters/moments/binning.h"

#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/seen_tiles.h"
#include "passes/maps/tile_knobs.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"

static bool reads_many_points(const device_material *material, const moment_partition *partition) {
    return partition->many_points || passes_mask_cuts_texels(material);
}

static void specialise_binning(const filter_context *context, const device_material *material,
                               const moment_partition *partition, bool colour,
                               specialisation_list *list) {
    passes_base_maps_specialise_points(material, reads_many_points(material, partition), list);
    passes_knob_specialise(context, &passes_knob_base, list);
    passes_specialise(list, SPECIALISE_BINS, partition->bins);
    passes_specialise(list, SPECIALISE_PARTITION, partition->kind);
    passes_specialise(list, SPECIALISE_BIN_COLOUR, colour);
}

/// Adds the pass that makes a level from the base maps. `samples`: along each axis of a texel; 0:
/// of level 0, all texels that it covers.
static void add_level(const filter_context *context, uint32_t index,
                      const moment_partition *partition, moment_map *moments, uint32_t level,
                      uint32_t samples) {
    const bool colour = partition->own_colours, seen = moments->map.tiles.version > 0;
    const device_material *material = &context->scene->materials[index];
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "moment_binning");
    passes_base_maps_read(context, material, colour, pass);
    passes_colour_maps_read(context, material, colour, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "binning_block", .resource = moments->bins});
    passes_reduced_map_write(&moments->map, pass, "moment_map", level);
    specialisation_list list = {.graph = context->graph};
    specialise_binning(context, material, partition, colour, &list);
    passes_specialise(&list, SPECIALISE_TEXEL_SAMPLES, samples);
    struct lobe_grid_constants constants = passes_lobe_grid_constants(context, material);
    if (colour && samples == 0 && !partition->many_points)
        passes_colour_square_specialise(material, &constants,
                                        passes_base_maps_are_interpolated(material), &list);
    constants.level = level;
    lobe_dispatch dispatch = {.shader = seen ? "filters/moments/binning_seen_tiles.comp"
                                             : "filters/moments/binning.comp",
                              .constants = &constants,
                              .constants_size = sizeof constants,
                              .specialisation = list.items,
                              .specialisation_count = list.count};
    passes_reduced_map_dispatch(&moments->map, pass, level, 1, &dispatch);
}

/// Samples of level 0, of whose texels each covers four of the base maps': none, where these have
/// fewer points.
static uint32_t finest_samples(const device_material *material, const moment_partition *partition,
                               uint32_t samples) {
    const uint32_t points = 4 * (reads_many_points(material, partition)        ? MANY_TEXEL_POINTS
                                 : passes_base_maps_are_interpolated(material) ? TEXEL_POINTS
                                                                               : 1);
    return samples * samples < points ? samples : 0;
}

moment_map passes_moment_binning(const filter_context *context, uint32_t index,
                                 const moment_partition *partition, lobe_resource bins,
                                 lobe_format format) {
    char name[64];
    snprintf(name, sizeof name, "moments of material %u", index);
    const device_material *material = &context->scene->materials[index];
    const uint32_t layers = passes_bin_layers(material, partition->bins, partition->own_colours);
    const uint32_t samples = passes_texel_samples(context);
    moment_map result = {.format = format, .bins = bins};
    result.map =
        passes_seen_map_declare_with(context, index, name, format, layers, samples == 0, bins);
    add_level(context, index, partition, &result, 0, finest_samples(material, partition, samples));
    for (uint32_t level = 1; samples > 0 && level < result.map.levels; level++)
        add_level(context, index, partition, &result, level, samples);
    if (samples == 0)
        passes_level_reduction(context->graph, &result.map);
    return result;
}
