#include "passes/renderer/samples/samples.h"

#include "passes/context/knob_values.h"
#include "passes/context/sample_count.h"
#include "passes/context/sample_pattern.h"
#include "passes/context/shared_knobs.h"
#include "passes/renderer/samples/sample_choice.h"
#include "shaders/interface/specialisation.h"

static bool shows_counts(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_view) == VIEW_SAMPLES;
}

bool passes_samples_several(const filter_context *context) {
    return !context->filter->supersamples &&
           (passes_sample_count(context).most > 1 || shows_counts(context));
}

static lobe_resource declare(const filter_context *context, const char *name, lobe_format format) {
    return lobe_graph_image(context->graph,
                            &(lobe_image_description){.name = name,
                                                      .format = format,
                                                      .width = context->view.width,
                                                      .height = context->view.height});
}

/// What the host drew hides the samples, too. Drawing the first one overwrites it.
static lobe_resource copy_occluder(const filter_context *context, const shading_targets *targets) {
    if (!targets->keep_depth)
        return (lobe_resource){0};
    lobe_resource copy = declare(context, "occluder", LOBE_FORMAT_D32_FLOAT);
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_TRANSFER, "occluder");
    return lobe_pass_copy(pass, targets->depth, (lobe_range){0}, copy, (lobe_range){0});
}

/// Draws the first sample of every pixel. Returns its radiance; alpha is the depth, 0 where nothing
/// is hit.
static lobe_resource draw_first(const filter_context *context, const draw_list *draws,
                                const shading_light *light, shading_targets *targets) {
    shading_sample sample = {.footprint = 1};
    shading_targets first = *targets;
    first.radiance = declare(context, "sum of samples", LOBE_FORMAT_RGBA32_FLOAT);
    first.without_background |= first.keep_radiance;
    first.keep_radiance = false;
    first.depth_as_coverage = true;
    passes_sample_position_around_centre(0, sample.position);
    passes_shading(context, draws, light, &sample, NULL, NULL, &first);
    targets->depth = first.depth;
    targets->normal_depth = first.normal_depth;
    targets->lobes_level = first.lobes_level;
    return first.radiance;
}

static lobe_resource add_sample(const filter_context *context, const sample_choice *choice,
                                uint32_t index, lobe_resource radiance, lobe_resource sum) {
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "sample_addition");
    lobe_pass_read(pass, &(lobe_binding){.name = "list_block", .resource = choice->list});
    lobe_pass_read(pass, &(lobe_binding){.name = "radiance", .resource = radiance});
    sum = lobe_pass_modify(pass, &(lobe_binding){.name = "sum", .resource = sum});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "shading/samples/sample_addition.comp",
                                              .constants = &index,
                                              .constants_size = sizeof index,
                                              .indirect = choice->arguments});
    return sum;
}

/// Draws and adds the samples that follow, each in the pixels that take it.
static lobe_resource draw_others(const filter_context *context, const draw_list *draws,
                                 const shading_light *light, const sample_choice *choice,
                                 const shading_targets *targets, lobe_resource occluder,
                                 lobe_resource sum) {
    const sample_count count = passes_sample_count(context);
    const shading_selection selection = {.counts = choice->counts,
                                         .occluder = occluder,
                                         .arguments = choice->arguments,
                                         .first_argument = 1};
    shading_targets one = {
        .width = targets->width,
        .height = targets->height,
        .radiance = declare(context, "sample", LOBE_FORMAT_RGBA32_FLOAT),
        .depth = declare(context, "sample's depth", LOBE_FORMAT_D32_FLOAT),
        .without_background = targets->without_background || targets->keep_radiance,
        .depth_as_coverage = true,
    };
    for (uint32_t i = 1; i < count.most; i++) {
        // Evenly spread thresholds meet a mask's coverage as closely as the samples' number allows.
        shading_sample sample = {.footprint = count.footprint, .dither = passes_radical_inverse(i)};
        passes_sample_position_around_centre(i, sample.position);
        passes_shading(context, draws, light, &sample, &selection, NULL, &one);
        sum = add_sample(context, choice, i, one.radiance, sum);
    }
    return sum;
}

/// Draws the means of the samples, or their number, into the targets' radiance.
static void resolve(const filter_context *context, lobe_resource counts, lobe_resource sum,
                    shading_targets *targets) {
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_RASTER, "sample_resolution");
    const lobe_specialisation view = {SPECIALISE_VIEW,
                                      passes_knob_choice(context, &passes_knob_view)};
    const lobe_binding bindings[] = {{.name = "counts", .resource = counts},
                                     {.name = "sum", .resource = sum}};
    const bool keep = targets->keep_radiance;
    targets->radiance =
        lobe_pass_colour(pass, 0,
                         &(lobe_attachment){.resource = targets->radiance,
                                            .load = keep ? LOBE_LOAD_KEEP : LOBE_LOAD_DISCARD});
    lobe_pass_draw(pass, &(lobe_draw){
                             .vertex_shader = "shading/background.vert",
                             .fragment_shader = "shading/samples/sample_resolution.frag",
                             .index_count = 3,
                             .blend = keep ? LOBE_BLEND_ALPHA : LOBE_BLEND_OFF,
                             .specialisation = &view,
                             .specialisation_count = 1,
                             .bindings = bindings,
                             .binding_count = 2,
                         });
}

void passes_samples(const filter_context *context, const draw_list *draws,
                    const shading_light *light, shading_targets *targets) {
    const lobe_resource occluder = copy_occluder(context, targets);
    lobe_resource sum = draw_first(context, draws, light, targets);
    const sample_choice choice = passes_sample_choice(context, draws, sum, targets->keep_radiance);
    sum = draw_others(context, draws, light, &choice, targets, occluder, sum);
    resolve(context, choice.counts, sum, targets);
}
