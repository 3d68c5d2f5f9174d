#include "passes/filters/mixture/likeness.h"

#include <stdio.h>

#include "passes/context/material_specialisation.h"
#include "passes/maps/filtered_maps.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/moment_bins.h"

static void add_level(lobe_graph *graph, const mixture_kind *kind, const moment_map *mixture,
                      reduced_map *likeness, const struct mixture_likeness_constants *constants) {
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "mixture_likeness");
    lobe_pass_read(pass, &(lobe_binding){.name = "moment_map", .resource = mixture->map.resource});
    lobe_pass_read(pass, &(lobe_binding){.name = "binning_block", .resource = mixture->bins});
    passes_reduced_map_write(likeness, pass, "likeness_map", constants->level);
    specialisation_list list = {.graph = graph};
    passes_specialise(&list, SPECIALISE_BINS, kind->components);
    passes_specialise(&list, SPECIALISE_BIN_COLOUR, kind->own_colours);
    lobe_dispatch dispatch = {
        .shader = "filters/mixture/likeness.comp",
        .constants = constants,
        .constants_size = sizeof *constants,
        .specialisation = list.items,
        .specialisation_count = list.count,
    };
    passes_reduced_map_dispatch(likeness, pass, constants->level, 1, &dispatch);
}

lobe_resource passes_mixture_likeness(const filter_context *context, uint32_t material,
                                      const mixture_kind *kind, const moment_map *mixture,
                                      float tolerance) {
    const lobe_grid grid = passes_lobe_grid(&context->scene->materials[material]);
    char name[64];
    snprintf(name, sizeof name, "likeness in material %u", material);
    reduced_map likeness = passes_reduced_map_declare(context->graph, name, LOBE_FORMAT_R8_UNORM,
                                                      grid.width, grid.height, 1, true);
    const lobe_sampler sampler =
        passes_filtered_map_sampler(context, &context->scene->materials[material], grid.map);
    for (uint32_t level = 0; level < likeness.levels; level++)
        add_level(context->graph, kind, mixture, &likeness,
                  &(struct mixture_likeness_constants){sampler.wrap_u == LOBE_WRAP_MIRROR,
                                                       sampler.wrap_v == LOBE_WRAP_MIRROR, level,
                                                       tolerance});
    return likeness.resource;
}
