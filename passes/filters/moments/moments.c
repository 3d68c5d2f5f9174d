#include <math.h>

#include "passes/context/filter.h"
#include "passes/context/knob_values.h"
#include "passes/filters/moments/binning.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_lobes.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/specialisation.h"

static const char *const partitions[] = {"fitted", "hats", "cap", NULL};
static const char *const bin_numbers[] = {"auto", "1", "2", "3", "4", "5", "6", NULL};
static const char *const colours[] = {"auto", "mean", "bins", NULL};
static const char *const storages[] = {"snorm16", "float16", "float32", NULL};

static const filter_knob partition_knob = {
    .description = {.name = "partition",
                    .summary = "how lobes are assigned to bins: fitted to the material; or one "
                               "for rough lobes and four, with a cap five, for directions",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = partitions,
                    .sweep = "hats,cap"},
};
static const filter_knob bins_knob = {
    .description =
        {.name = "bins",
         .summary = "how many bins are fitted; auto: as few as serve the material's maps as well",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 6,
         .choices = bin_numbers,
         .sweep = "1,2,3,4"},
};
static const filter_knob colour_knob = {
    .description = {.name = "colour",
                    .summary =
                        "the specular colour is the footprint's mean, or each bin has its own, for "
                        "half as much memory again; auto: its own where a map says what is metal",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 2,
                    .choices = colours,
                    .sweep = "mean,bins"},
};
static const filter_knob least_share_knob = {
    .description = {.name = "least_share",
                    .summary = "bins with a smaller share of the footprint are skipped",
                    .maximum = 0.1,
                    .initial = 1e-3},
    .feeds = KNOB_FEEDS_FILTER(moments_knobs, least_share),
};
static const filter_knob storage_knob = {
    .description =
        {.name = "storage",
         .summary = "format of the moments; snorm16 keeps the digits of the material's own range",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 2,
         .choices = storages,
         .sweep = "float16,float32"},
};
static const filter_knob *const knobs[] = {
    &partition_knob,        &bins_knob,          &colour_knob,
    &least_share_knob,      &passes_knob_probes, &passes_knob_bias,
    &passes_knob_curvature, &storage_knob,       NULL,
};

static lobe_format format_of(const filter_context *context) {
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA16_SNORM, LOBE_FORMAT_RGBA16_FLOAT,
                                          LOBE_FORMAT_RGBA32_FLOAT};
    return formats[(int)passes_knob_choice(context, &storage_knob)];
}

/// Whether a map is read at the same coordinates as the lobes, and is no finer.
static bool lies_under_lobes(const device_material *material, uint32_t map) {
    const lobe_grid grid = passes_lobe_grid(material);
    const device_map *own = &material->maps[map];
    return !own->use || (own->width <= grid.width && own->height <= grid.height &&
                         passes_lobe_grid_shares_coordinates(&grid, own->use));
}

/// Whether bins have their own specular colour: as the user chose, or else if a map makes parts of
/// the material metal, so that colour and width vary together.
static bool has_bin_colour(const filter_context *context, const device_material *material) {
    enum { AUTOMATIC, MEAN };
    int wanted = (int)passes_knob_choice(context, &colour_knob);
    if (wanted == MEAN || (wanted == AUTOMATIC && !material->metallic_varies))
        return false;
    return lies_under_lobes(material, MAP_BASE_COLOUR) &&
           lies_under_lobes(material, MAP_SPECULAR) && lies_under_lobes(material, MAP_WIDTH);
}

/// Largest value of a colour map; 1 for those of eight bits.
static float largest_texel(const lobe_scene *scene, const device_map *map) {
    const lobe_image *image = map->use ? &scene->images[map->use->image].image : NULL;
    float largest = 1, texel[4];
    for (uint32_t i = 0; image && i < image->width * image->height; i++) {
        if (!passes_image_texel(image, i % image->width, i / image->width, texel))
            return largest;
        largest = fmaxf(largest, fmaxf(texel[0], fmaxf(texel[1], texel[2])));
    }
    return largest;
}

/// An upper bound of the material's colours: those of the bins and the diffuse one.
static float largest_colour(const lobe_scene *scene, const device_material *material) {
    const lobe_material *source = material->material;
    float base = 1, specular = 1;
    for (int i = 0; i < 3; i++) {
        base = fmaxf(base, source->base_colour[i]);
        for (uint32_t k = 0; source->model != LOBE_MATERIAL_MICROFACET && k < source->lobe_count;
             ++k)
            specular = fmaxf(specular, source->lobes[k].colour[i] /
                                           fmaxf(passes_material_lobe_share(source, k), 1e-6f));
    }
    return fmaxf(base * largest_texel(scene, &material->maps[MAP_BASE_COLOUR]),
                 specular * largest_texel(scene, &material->maps[MAP_SPECULAR]));
}

// ---------------------------------------------------------------------------------------------
// What is kept for a material

typedef struct prepared_moments {
    uint32_t kind, bins; ///< as requested by the settings
    moment_partition partition;
    float largest_colour; ///< 0: not measured yet
} prepared_moments;

static lobe_result prepare_partition(const filter_context *context, uint32_t material,
                                     void **slot) {
    const uint32_t kind = passes_knob_choice(context, &partition_knob);
    const uint32_t bins = passes_knob_choice(context, &bins_knob);
    prepared_moments *prepared = *slot;
    if (prepared && prepared->kind == kind && prepared->bins == bins)
        return LOBE_OK;
    prepared_moments made = {.kind = kind, .bins = bins};
    lobe_result result = passes_moment_partition_make(context->scene, material, kind, bins,
                                                      context->host, &made.partition);
    if (result != LOBE_OK)
        return result;
    if (prepared)
        made.largest_colour = prepared->largest_colour;
    else
        prepared = lobe_allocate(lobe_host_allocator(context->host), 1, sizeof *prepared);
    if (!prepared)
        return LOBE_ERROR_OUT_OF_MEMORY;
    *prepared = made;
    *slot = prepared;
    return LOBE_OK;
}

static lobe_result prepare(const filter_context *context, uint32_t index, void **slot) {
    const device_material *material = &context->scene->materials[index];
    const lobe_grid grid = passes_lobe_grid(material);
    if (!passes_lobe_grid_varies(&grid))
        return LOBE_OK;
    lobe_result result = prepare_partition(context, index, slot);
    prepared_moments *prepared = *slot;
    if (result == LOBE_OK && prepared->largest_colour == 0 && has_bin_colour(context, material))
        prepared->largest_colour = largest_colour(context->scene->scene, material);
    return result;
}

// ---------------------------------------------------------------------------------------------
// Maps

static void specialise_bins(const moment_partition *partition, bool colour,
                            filtered_appearance *appearance) {
    passes_appearance_specialise(appearance, SPECIALISE_BINS, partition->bins);
    passes_appearance_specialise(appearance, SPECIALISE_BIN_COLOUR, colour);
}

static moment_map build_moments(const filter_context *context, uint32_t material,
                                const prepared_moments *prepared, filtered_appearance *appearance) {
    bool colour = has_bin_colour(context, &context->scene->materials[material]);
    specialise_bins(&prepared->partition, colour, appearance);
    return passes_moment_binning(context, material, &prepared->partition, format_of(context),
                                 colour, colour ? prepared->largest_colour : 1);
}

/// `prepared`: NULL if the material's lobes do not vary.
static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    static const struct moment_binning_constants none;
    const uint32_t material = context->scene->instances[instance].material;
    moment_map moments = {0};
    if (prepared)
        moments = build_moments(context, material, prepared, appearance);
    else
        moments.range = lobe_graph_upload(context->graph, "no bins", &none, sizeof none);
    passes_lobe_map_bind(context, material, "moment_map", prepared ? &moments.map : NULL,
                         moments.format, appearance);
    passes_appearance_bind(appearance, "binning_block", moments.range, (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_MIXTURE, prepared != NULL);
    passes_filtered_maps_build(context, material, appearance);
}

const lobe_filter passes_filter_moments = {
    .name = "moments",
    .summary = "moments of lobes in bins fitted to the material",
    .paper = "",
    .shading = "moments",
    .knobs = knobs,
    .prepare = prepare,
    .forget = lobe_release,
    .build = build,
};
