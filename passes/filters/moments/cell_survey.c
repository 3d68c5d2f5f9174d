#include "passes/filters/moments/cell_survey.h"

#include <stdio.h>

#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/moment_refit.h"

static uint32_t cell_count(uint32_t texels) {
    return texels < SURVEY_CELLS ? texels : SURVEY_CELLS;
}

/// Retained, although only moment_refit reads it: where some frames change texels and others do
/// not, transient buffers would move, for which the graph waits.
static lobe_resource declare(lobe_graph *graph, const char *content, uint32_t material,
                             size_t size) {
    char name[64];
    snprintf(name, sizeof name, "%s of material %u", content, material);
    return lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = name, .size = size, .retained = true});
}

static void dispatch(lobe_graph *graph, const device_material *material, bool bright_texels,
                     const struct cell_survey_constants *constants, lobe_pass *pass) {
    enum { THREADS = 64 };
    specialisation_list list = {.graph = graph};
    passes_base_maps_specialise(material, &list);
    passes_specialise(&list, SPECIALISE_BRIGHT_TEXELS, bright_texels);
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "filters/moments/cell_survey.comp",
                                 .threads = {THREADS * constants->columns * constants->rows},
                                 .constants = constants,
                                 .constants_size = sizeof *constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
}

static struct cell_survey_constants cells_of(const filter_context *context,
                                             const device_material *material, uint32_t part) {
    const struct lobe_grid_constants grid = passes_lobe_grid_constants(context, material);
    return (struct cell_survey_constants){.width = grid.width,
                                          .height = grid.height,
                                          .columns = cell_count(grid.width),
                                          .rows = cell_count(grid.height),
                                          .part = part,
                                          .alpha = grid.alpha,
                                          .cutoff = grid.cutoff};
}

cell_survey passes_moment_cell_survey_declare(const filter_context *context, uint32_t index) {
    const device_material *material = &context->scene->materials[index];
    const struct cell_survey_constants constants = cells_of(context, material, 0);
    cell_survey survey = {.cells = constants.columns * constants.rows};
    survey.lobe_count = survey.cells * SURVEY_DRAWS * material->lobe_count;
    survey.extremes = declare(context->graph, "extremes of lobes", index,
                              survey.cells * sizeof(struct survey_extremes));
    survey.lobes =
        declare(context->graph, "sample of lobes", index, survey.lobe_count * sizeof(float4));
    return survey;
}

void passes_moment_cell_survey(const filter_context *context, uint32_t index, bool bright_texels,
                               uint32_t part, cell_survey *survey) {
    const device_material *material = &context->scene->materials[index];
    const struct cell_survey_constants constants = cells_of(context, material, part);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "moment_cell_survey");
    passes_base_maps_read(context, material, false, pass);
    passes_colour_maps_read(context, material, bright_texels, pass);
    survey->extremes = lobe_pass_write(
        pass, &(lobe_binding){.name = "extremes_block", .resource = survey->extremes});
    survey->lobes =
        lobe_pass_write(pass, &(lobe_binding){.name = "lobes_block", .resource = survey->lobes});
    dispatch(context->graph, material, bright_texels, &constants, pass);
}
