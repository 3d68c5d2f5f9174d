#include "passes/filters/moments/refit.h"

#include <stddef.h>
#include <stdio.h>

#include "passes/context/material_specialisation.h"
#include "passes/filters/moments/cell_survey.h"
#include "passes/maps/base_maps.h"
#include "passes/maps/tile_knobs.h"
#include "shaders/interface/moment_refit.h"

static void read_inputs(const filter_context *context, uint32_t index,
                        const moment_partition *partition, const cell_survey *survey,
                        lobe_pass *pass) {
    const device_material *material = &context->scene->materials[index];
    const lobe_resource first = lobe_graph_upload(
        context->graph, "first bins", &partition->constants, sizeof partition->constants);
    const lobe_resource constants =
        lobe_graph_import_buffer(context->graph, material->map_constants);
    lobe_pass_read(pass, &(lobe_binding){.name = "material_block", .resource = constants});
    lobe_pass_read(pass, &(lobe_binding){.name = "extremes_block", .resource = survey->extremes});
    lobe_pass_read(pass, &(lobe_binding){.name = "lobes_block", .resource = survey->lobes});
    lobe_pass_read(pass, &(lobe_binding){.name = "first_block", .resource = first});
}

static void dispatch(lobe_graph *graph, const device_material *material,
                     const moment_partition *partition, bool bright_texels,
                     const struct refit_constants *constants, lobe_pass *pass) {
    specialisation_list list = {.graph = graph};
    passes_material_specialise(material, &list);
    passes_specialise(&list, SPECIALISE_PARTITION, partition->kind);
    passes_specialise(&list, SPECIALISE_BRIGHT_TEXELS, bright_texels);
    lobe_pass_dispatch(pass, &(lobe_dispatch){
                                 .shader = "filters/moments/refit.comp",
                                 .constants = constants,
                                 .constants_size = sizeof *constants,
                                 .specialisation = list.items,
                                 .specialisation_count = list.count,
                             });
}

static void name_state(uint32_t index, char name[64]) {
    snprintf(name, 64, "fit of material %u", index);
}

static lobe_resource declare_state(const filter_context *context, uint32_t index, bool follows) {
    char name[64];
    name_state(index, name);
    return lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){
                            .name = name,
                            .size = sizeof(struct fit_state),
                            .retained = true,
                            .evolves = true,
                            .settles = follows ? FIT_RESTS_AFTER + 2 * (FITS_OF_SETTLING + 1) : 0,
                            .rest_offset = offsetof(struct fit_state, unchanged)});
}

/// Gives the pass what the last fit left: zeros, if there was none. Where nothing of it counts,
/// what is made of the bins is the same in all graphs.
static void continue_fit(lobe_graph *graph, lobe_resource state, bool follows, lobe_pass *pass) {
    static const float zero[4] = {0};
    if (follows && !lobe_graph_has_content(graph, state)) {
        lobe_pass *empty = lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "moment_no_fit");
        state = lobe_pass_fill(empty, state, (lobe_range){0}, zero);
    }
    const lobe_binding binding = {.name = "state_block", .resource = state};
    (void)(follows ? lobe_pass_modify(pass, &binding) : lobe_pass_write(pass, &binding));
}

void passes_moment_refit_forget(lobe_graph *graph, uint32_t index) {
    char name[64];
    name_state(index, name);
    lobe_graph_forget_buffer(graph, name);
}

static lobe_resource declare_bins(const filter_context *context, uint32_t index) {
    char name[64];
    snprintf(name, sizeof name, "bins of material %u", index);
    return lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){.name = name,
                                                   .size = sizeof(struct moment_binning_constants),
                                                   .retained = true});
}

lobe_resource passes_moment_refit(const filter_context *context, uint32_t index,
                                  const moment_partition *partition, const refit_request *request) {
    lobe_resource bins = declare_bins(context, index);
    const lobe_resource state = declare_state(context, index, request->follows);
    // Declared in any case, so that frames that keep the bins free nothing.
    cell_survey survey = passes_moment_cell_survey_declare(context, index);
    if (request->keeps && lobe_graph_has_content(context->graph, bins))
        return bins;
    const uint32_t part = passes_texel_samples(context) > 0 ? SURVEY_PART : 0;
    passes_moment_cell_survey(context, index, request->bright_texels, part, &survey);
    const struct refit_constants constants = {
        survey.cells,
        survey.lobe_count,
        partition->points,
        partition->bins,
        partition->has_first,
        request->follows,
        passes_base_maps_are_interpolated(&context->scene->materials[index])};
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "moment_refit");
    read_inputs(context, index, partition, &survey, pass);
    continue_fit(context->graph, state, request->follows, pass);
    bins = lobe_pass_write(pass, &(lobe_binding){.name = "binning_block", .resource = bins});
    dispatch(context->graph, &context->scene->materials[index], partition, request->bright_texels,
             &constants, pass);
    return bins;
}
