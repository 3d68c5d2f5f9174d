#include <math.h>
#include <string.h>

#include "passes/context/filter.h"
#include "passes/context/fit_work.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/moments/binning.h"
#include "passes/filters/moments/factor_change.h"
#include "passes/filters/moments/refit.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/maps/moment_map.h"
#include "passes/maps/tile_knobs.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/specialisation.h"

static const char *const partitions[] = {"fitted", "hats", "cap", NULL};
static const char *const bin_numbers[] = {"auto", "1", "2", "3", "4", "5", "6", NULL};
static const char *const refits[] = {"follow", "anew", NULL};
static const char *const colours[] = {"auto", "mean", "bins", NULL};

static const filter_knob partition_knob = {
    .description = {.name = "partition",
                    .summary = "how lobes are assigned to bins: fitted to the material; or one "
                               "for rough lobes and four, with a cap five, for directions",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = partitions,
                    .sweep = "hats,cap"},
    .decides_slots = true,
};
static const filter_knob bins_knob = {
    .description =
        {.name = "bins",
         .summary = "how many bins are fitted; auto: as many as are worth their time, see bin_gain",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 6,
         .choices = bin_numbers,
         .sweep = "1,2,3,4"},
    .decides_slots = true,
};
/// A choice, because each value has a partition of its own.
static const char *const bin_gains[] = {"0", "0.05", "0.115", "0.2", "0.4", NULL};
static const double bin_gain_values[] = {0, 0.05, 0.115, 0.2, 0.4};

static const filter_knob bin_gain_knob = {
    .description = {.name = "bin_gain",
                    .summary =
                        "part of the squared error that each fetch of more bins, or of their "
                        "own colours, has to take away to be worth its time; 0: the least "
                        "error at any cost",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 4,
                    .initial = 2,
                    .choices = bin_gains,
                    .sweep = "0,0.05,0.4"},
    .decides_slots = true,
};
static const filter_knob colour_knob = {
    .description =
        {.name = "colour",
         .summary = "the specular colour is the footprint's mean, or each bin has its own, for "
                    "half as much memory again; auto: its own where that serves the maps better",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 2,
         .choices = colours,
         .sweep = "mean,bins"},
    .decides_slots = true,
};
static const filter_knob refit_knob = {
    .description = {.name = "refit",
                    .summary =
                        "where texels change, bins follow from those of the frames before, "
                        "without jumps; or each fit is anew, of its own frame's texels alone",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = refits},
};
static const filter_knob frames_of_fit_knob = {
    .description = {.name = "frames_of_fit",
                    .summary = "how many frames bins serve where texels change: each fit is also "
                               "that of the frames after it; 1: each frame has its own",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 64,
                    .initial = 1},
};
static const filter_knob *const knobs[] = {
    &partition_knob,
    &bins_knob,
    &bin_gain_knob,
    &colour_knob,
    &refit_knob,
    &frames_of_fit_knob,
    &passes_knob_least_share,
    &passes_knob_probes,
    &passes_knob_anisotropy,
    &passes_knob_bias,
    &passes_knob_level_blend,
    &passes_knob_curvature,
    &passes_knob_bin_storage,
    &passes_knob_built,
    &passes_knob_texel_samples,
    &passes_knob_normal_mapping,
    NULL,
};

/// Bins can have their own specular colour only if its maps lie under the lobes'.
static bin_colour colour_of_bins(const filter_context *context, const device_material *material) {
    static const bin_colour wanted[] = {BIN_COLOUR_AUTOMATIC, BIN_COLOUR_MEAN, BIN_COLOUR_OWN};
    return passes_colours_lie_under_lobes(material)
               ? wanted[passes_knob_choice(context, &colour_knob)]
               : BIN_COLOUR_MEAN;
}

/// Whether texels of a map of colours may exceed one.
static bool has_bright_texels(const device_map *map) {
    switch (map->use ? map->format : LOBE_FORMAT_RGBA8_UNORM) {
    case LOBE_FORMAT_R32_FLOAT:
    case LOBE_FORMAT_RG32_FLOAT:
    case LOBE_FORMAT_RGBA32_FLOAT:
        return true;
    default:
        return false;
    }
}

/// Largest value of a colour map, at least 1.
static float largest_texel(const lobe_scene *scene, const device_map *map) {
    float largest = 1, texel[4];
    if (!has_bright_texels(map))
        return largest;
    const lobe_image *image = &scene->images[map->use->image].image;
    for (uint32_t i = 0; i < image->width * image->height; i++) {
        if (!passes_image_texel(image, i % image->width, i / image->width, texel))
            return largest;
        largest = fmaxf(largest, fmaxf(texel[0], fmaxf(texel[1], texel[2])));
    }
    return largest;
}

// ---------------------------------------------------------------------------------------------
// What is kept for a material

typedef struct prepared_moments {
    moment_partition partition;
    uint32_t texel_versions[MAP_COUNT]; ///< of the material, when the partition was made
    struct material_constants factors;  ///< at that time
    struct material_constants latest;   ///< in the last frame
    bool moves;                         ///< they were others than in the frame before
    bool bright_texels;                 ///< the bins' colours may exceed one
    uint32_t age;                       ///< frames since one that fits the bins to other texels
} prepared_moments;

static void measure_colours(const lobe_scene *scene, const device_material *material,
                            prepared_moments *prepared) {
    const device_map *base = &material->maps[MAP_BASE_COLOUR];
    const device_map *specular = &material->maps[MAP_SPECULAR];
    prepared->bright_texels = has_bright_texels(base) || has_bright_texels(specular);
    prepared->partition.constants.largest[1] =
        fmaxf(largest_texel(scene, base), largest_texel(scene, specular));
}

static lobe_result prepare_partition(const filter_context *context, uint32_t index, void **slot) {
    const partition_request request = {
        .kind = passes_knob_choice(context, &partition_knob),
        .bins = {.bins = passes_knob_choice(context, &bins_knob),
                 .colour = colour_of_bins(context, &context->scene->materials[index]),
                 .gain = bin_gain_values[passes_knob_choice(context, &bin_gain_knob)]}};
    prepared_moments *prepared =
        lobe_allocate(lobe_host_allocator(context->host), 1, sizeof *prepared);
    if (!prepared)
        return LOBE_ERROR_OUT_OF_MEMORY;
    lobe_result result = passes_moment_partition_make(context->scene, index, &request,
                                                      context->host, &prepared->partition);
    if (result != LOBE_OK) {
        lobe_release(prepared);
        return result;
    }
    const device_material *material = &context->scene->materials[index];
    prepared->factors = prepared->latest = material->values;
    memcpy(prepared->texel_versions, material->texel_versions, sizeof prepared->texel_versions);
    if (prepared->partition.own_colours)
        measure_colours(context->scene->scene, material, prepared);
    *slot = prepared;
    return LOBE_OK;
}

static bool is_dry(const filter_context *context) {
    return context->work && context->work->is_dry;
}

static void grow_older(const filter_context *context, prepared_moments *prepared) {
    const uint32_t frames = (uint32_t)passes_knob_value(context, &frames_of_fit_knob);
    if (!is_dry(context))
        prepared->age = prepared->age + 1 < frames ? prepared->age + 1 : 0;
}

/// A single change of the material's numbers is worth bins that the host makes anew. Where one
/// follows another from frame to frame, the device fits those that there are, while the numbers are
/// near enough.
static bool serves(const filter_context *context, const device_material *material,
                   prepared_moments *prepared, bool *moves) {
    const struct material_constants *now = &material->values;
    const bool moved = prepared->moves;
    *moves = passes_factor_change(&prepared->latest, now) != FACTORS_KEEP_LOBES;
    if (!is_dry(context)) {
        prepared->moves = *moves;
        prepared->latest = *now;
    }
    return !*moves ||
           (moved && passes_factor_change(&prepared->factors, now) != FACTORS_REPLACE_LOBES);
}

static lobe_result prepare(const filter_context *context, uint32_t index, void **slot) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    prepared_moments *prepared = *slot;
    bool moves = false;
    if (!passes_lobe_grid_varies(&grid))
        return LOBE_OK;
    if (prepared && serves(context, material, prepared, &moves)) {
        grow_older(context, prepared);
        return LOBE_OK;
    }
    lobe_release(prepared);
    *slot = NULL;
    const lobe_result result = prepare_partition(context, index, slot);
    if (!is_dry(context))
        passes_moment_refit_forget(context->graph, index);
    if (*slot)
        ((prepared_moments *)*slot)->moves = moves;
    return result;
}

// ---------------------------------------------------------------------------------------------
// Maps

/// Whether a map has other texels than the bins were made for, as far as the host knows.
static bool has_other_texels(const device_scene *scene, const device_material *material,
                             const prepared_moments *prepared, uint32_t map) {
    const device_map *own = &material->maps[map];
    return (own->use && scene->scene->images[own->image].on_device) ||
           material->texel_versions[map] != prepared->texel_versions[map];
}

/// Whether the lobes are others than those that the bins were fitted to, or there are no such bins.
static bool needs_refit(const device_scene *scene, const device_material *material,
                        const prepared_moments *prepared) {
    static const uint32_t maps[] = {MAP_NORMAL, MAP_WIDTH, MAP_BASE_COLOUR, MAP_SPECULAR};
    const uint32_t count = prepared->bright_texels ? 4 : 2;
    bool other = passes_factor_change(&prepared->factors, &material->values) != FACTORS_KEEP_LOBES;
    for (uint32_t i = 0; i < count; i++)
        other |= has_other_texels(scene, material, prepared, maps[i]);
    return other || !prepared->partition.has_first;
}

static lobe_resource bins_of(const filter_context *context, uint32_t material,
                             const prepared_moments *prepared) {
    const moment_partition *partition = &prepared->partition;
    // Where nothing is drawn, the pipelines of a fit are wanted.
    const refit_request request = {.bright_texels = prepared->bright_texels,
                                   .keeps = prepared->age > 0 && !is_dry(context),
                                   .follows = passes_knob_choice(context, &refit_knob) == 0 &&
                                              partition->kind == PARTITION_FITTED};
    if (needs_refit(context->scene, &context->scene->materials[material], prepared))
        return passes_moment_refit(context, material, partition, &request);
    return lobe_graph_upload(context->graph, "bins", &partition->constants,
                             sizeof partition->constants);
}

static moment_map build_moments(const filter_context *context, uint32_t material,
                                const prepared_moments *prepared, filtered_appearance *appearance) {
    const moment_partition *partition = &prepared->partition;
    passes_bins_specialise(&context->scene->materials[material], partition->bins,
                           partition->own_colours, appearance);
    passes_appearance_specialise(appearance, SPECIALISE_MIRRORED_BINS, partition->own_colours);
    return passes_moment_binning(context, material, partition, bins_of(context, material, prepared),
                                 passes_bin_format(context));
}

/// `prepared`: NULL if the material's lobes do not vary.
static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    moment_map moments;
    if (prepared)
        moments = build_moments(context, material, prepared, appearance);
    passes_bin_appearance_bind(context, material, prepared ? &moments : NULL, appearance);
    passes_bin_texels_bind(context, material, prepared ? &moments : NULL, appearance);
}

const lobe_filter passes_filter_moments = {
    .name = "moments",
    .summary = "moments of lobes in bins fitted to the material",
    .paper = "",
    .shading = "moments",
    .shading_cost = 5.0f,
    .keeps_widths = true,
    .knobs = knobs,
    .fetches_for_lights = true,
    .prepare = prepare,
    .adapts_to_texels = true,
    .adapts_to_factors = true,
    .forget = lobe_release,
    .build = build,
};
