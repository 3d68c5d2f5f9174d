#include "passes/filters/mixture/samples.h"

#include <stdio.h>

#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/moment_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/lobe_grid.h"
#include "shaders/interface/moment_bins.h"

static mixture_samples declare(lobe_graph *graph, uint32_t index, const lobe_grid *grid,
                               uint32_t layers, bool retained) {
    const uint32_t columns = (grid->width + MIXTURE_TILE - 1) / MIXTURE_TILE;
    const uint32_t rows = (grid->height + MIXTURE_TILE - 1) / MIXTURE_TILE;
    mixture_samples samples = {
        .tiles = columns * rows, .width = grid->width, .height = grid->height};
    char name[64];
    snprintf(name, sizeof name, "samples of lobes of material %u", index);
    samples.lobes = lobe_graph_image(graph, &(lobe_image_description){
                                                .name = name,
                                                .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                .width = grid->width,
                                                .height = grid->height,
                                                .layers = layers,
                                                .retained = retained,
                                            });
    snprintf(name, sizeof name, "extremes of lobes of material %u", index);
    samples.extremes = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name,
                                          .size = samples.tiles * sizeof(struct mixture_extremes),
                                          .retained = retained});
    return samples;
}

mixture_samples passes_mixture_samples(const filter_context *context, uint32_t index,
                                       uint32_t plane, bool own_colours, bool retained) {
    enum { GROUP_SIDE = 8 };
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    const uint32_t layers = passes_bin_layers(material, material->lobe_count, own_colours);
    mixture_samples samples = declare(context->graph, index, &grid, layers, retained);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "mixture_samples");
    passes_base_maps_read(context, material, own_colours, pass);
    passes_colour_maps_read(context, material, own_colours, pass);
    samples.lobes =
        lobe_pass_write(pass, &(lobe_binding){.name = "sample_map", .resource = samples.lobes});
    samples.extremes = lobe_pass_write(
        pass, &(lobe_binding){.name = "extremes_block", .resource = samples.extremes});
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    passes_knob_specialise(context, &passes_knob_base, &list);
    passes_specialise(&list, SPECIALISE_BIN_COLOUR, own_colours);
    passes_specialise(&list, SPECIALISE_MIXTURE_PLANE, plane);
    const struct lobe_grid_constants constants = passes_lobe_grid_constants(context, material);
    const uint32_t columns = (grid.width + MIXTURE_TILE - 1) / MIXTURE_TILE;
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){
                  .shader = "filters/mixture/samples.comp",
                  .threads = {GROUP_SIDE * columns, GROUP_SIDE * (samples.tiles / columns)},
                  .constants = &constants,
                  .constants_size = sizeof constants,
                  .specialisation = list.items,
                  .specialisation_count = list.count,
              });
    return samples;
}
