#include "passes/filters/moments/binning.h"

#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/lobe_grid.h"

static void specialise_binning(const filter_context *context, const device_material *material,
                               const moment_partition *partition, bool colour,
                               specialisation_list *list) {
    passes_base_maps_specialise(material, list);
    passes_knob_specialise(context, &passes_knob_base, list);
    passes_specialise(list, SPECIALISE_BINS, partition->bins);
    passes_specialise(list, SPECIALISE_PARTITION, partition->kind);
    passes_specialise(list, SPECIALISE_BIN_COLOUR, colour);
}

moment_map passes_moment_binning(const filter_context *context, uint32_t index,
                                 const moment_partition *partition, lobe_resource bins,
                                 lobe_format format) {
    const bool colour = partition->own_colours;
    const device_material *material = &context->scene->materials[index];
    char name[64];
    snprintf(name, sizeof name, "moments of material %u", index);
    uint32_t layers = colour ? 3 * partition->bins + 1 : 2 * partition->bins;
    moment_map result = {.format = format, .bins = bins};
    result.map = passes_reduced_map_declare(context->graph, name, format, partition->width,
                                            partition->height, layers);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "moment_binning");
    passes_base_maps_read(context, material, colour, pass);
    passes_colour_maps_read(context, material, colour, pass);
    lobe_pass_read(pass, &(lobe_binding){.name = "binning_block", .resource = bins});
    result.map.resource = lobe_pass_write(
        pass, &(lobe_binding){"moment_map", result.map.resource, .range = {0, 1, 0, layers}});
    specialisation_list list = {.graph = context->graph};
    specialise_binning(context, material, partition, colour, &list);
    const struct lobe_grid_constants constants = {partition->width, partition->height};
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "filters/moments/binning.comp",
                                 .threads = {result.map.width, result.map.height, 1},
                                 .constants = &constants,
                                 .constants_size = sizeof constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
    passes_level_reduction(context->graph, &result.map);
    return result;
}
