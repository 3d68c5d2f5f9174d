#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/mixture/knobs.h"
#include "passes/filters/mixture/likeness.h"
#include "passes/filters/mixture/record.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/kept/record.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "shaders/interface/moment_bins.h"

/// After k-means.
enum { OWN_STEPS = 4 };

static const char *const shapes[] = {"auto", "round", "oval", NULL};
static const char *const colours[] = {"auto", "mean", "components", NULL};

static const filter_knob shape_knob = {
    .description = {.name = "shape",
                    .summary =
                        "shape of the Gaussians while lobes are shared out among them, after "
                        "which they have any; auto: whichever serves the maps better",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = shapes,
                    .sweep = "round,oval"},
    .decides_slots = true,
};
static const filter_knob colour_knob = {
    .description = {.name = "colour",
                    .summary =
                        "the specular colour is the footprint's mean, or each component has its "
                        "own, for half as much memory again; auto: its own where a map changes it",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = colours,
                    .sweep = "mean,components"},
    .decides_slots = true,
};
/// A choice, because each value has maps of its own.
static const char *const blend_errors[] = {"0", "0.001", "0.01", "0.1", "1", NULL};
static const double blend_error_values[] = {0, 0.001, 0.01, 0.1, 1};

static const filter_knob blend_error_knob = {
    .description = {.name = "blend_error",
                    .summary =
                        "squared error, in parts of what is blended, up to which components are "
                        "blended with neighbouring texels', and texels keep those of coarser "
                        "ones; 0: all are evaluated one by one; 1: all are blended",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 4,
                    .initial = 2,
                    .choices = blend_errors,
                    .sweep = "0,0.1,1"},
    .decides_slots = true,
};
static const filter_knob *const knobs[] = {
    &passes_knob_components,
    &passes_knob_fit_steps,
    &shape_knob,
    &colour_knob,
    &blend_error_knob,
    &passes_knob_least_share,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_bin_storage,
    &passes_knob_normal_mapping,
    NULL,
};

static bool has_own_colours(const filter_context *context, const device_material *material) {
    enum { AUTOMATIC, MEAN, OWN };
    const uint32_t choice = passes_knob_choice(context, &colour_knob);
    if (choice == MEAN || !passes_colours_lie_under_lobes(material))
        return false;
    return choice == OWN || passes_specular_colour_varies(material);
}

/// Where the device's own sampler reads the maps, only it knows which texels it takes.
static double blend_error(const filter_context *context) {
    return passes_knob_value(context, &passes_knob_anisotropy) > 1
               ? 1
               : blend_error_values[passes_knob_choice(context, &blend_error_knob)];
}

static mixture_kind kind_of(const filter_context *context, uint32_t material) {
    const bool tries_own = blend_error(context) < 1;
    return (mixture_kind){
        .components = (uint32_t)passes_knob_value(context, &passes_knob_components),
        .steps = (uint32_t)passes_knob_value(context, &passes_knob_fit_steps),
        .shape = passes_knob_choice(context, &shape_knob),
        .own_colours = has_own_colours(context, &context->scene->materials[material]),
        .start = tries_own ? MIXTURE_START_CLOSEST : MIXTURE_START_PARENT,
        .own_steps = tries_own ? OWN_STEPS : 0,
        .least_gain = (float)blend_error(context),
        .format = passes_bin_format(context),
    };
}

static lobe_result prepare(const filter_context *context, uint32_t material, void **slot) {
    const mixture_kind kind = kind_of(context, material);
    return passes_mixture_prepare(context, material, &kind, slot);
}

/// Which texels shading evaluates one by one.
static void find_single_texels(const filter_context *context, uint32_t material,
                               const mixture_kind *kind, moment_map *mixture,
                               filtered_appearance *appearance) {
    const double error = blend_error(context);
    const uint32_t single = error >= 1  ? SINGLE_TEXELS_NEVER
                            : error > 0 ? SINGLE_TEXELS_UNLIKE
                                        : SINGLE_TEXELS_ALWAYS;
    if (single == SINGLE_TEXELS_UNLIKE)
        mixture->likeness = passes_mixture_likeness(context, material, kind, mixture, (float)error);
    passes_appearance_specialise(appearance, SPECIALISE_SINGLE_TEXELS, single);
}

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    const mixture_kind kind = kind_of(context, material);
    moment_map mixture = {0};
    const bool has = passes_mixture_build(context, material, &kind, prepared, &mixture);
    if (has) {
        passes_bins_specialise(&context->scene->materials[material], kind.components,
                               kind.own_colours, appearance);
        find_single_texels(context, material, &kind, &mixture, appearance);
    }
    passes_bin_appearance_bind(context, material, has ? &mixture : NULL, appearance);
    passes_bin_texels_bind(context, material, has ? &mixture : NULL, appearance);
}

const lobe_filter passes_filter_mixture = {
    .name = "mixture",
    .summary = "a mixture of Gaussians fitted to the lobes under each texel",
    .paper = "after Tan et al. 2005, Multiresolution Reflectance Filtering",
    .shading = "moments",
    .shading_cost = 26.0f,
    .keeps_widths = true,
    .knobs = knobs,
    .fetches_for_lights = true,
    .prepare = prepare,
    .adapts_to_texels = true,
    .save = passes_kept_save,
    .forget = passes_kept_forget,
    .build = build,
};
