#include <math.h>
#include <string.h>

#include "passes/filters/filters.h"
#include "passes/filters/moments/binning.h"
#include "passes/maps/filtered_maps.h"
#include "passes/upload/image_texel.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/specialisation.h"

static const char *const partitions[] = {"fitted", "hats", "cap", NULL};
static const char *const bin_numbers[] = {"auto", "1", "2", "3", "4", "5", "6", NULL};
static const char *const colours[] = {"auto", "mean", "bins", NULL};
static const char *const storages[] = {"snorm16", "float16", "float32", NULL};

static const lobe_knob partition_knob = {
    .name = "partition",
    .summary = "how lobes are shared out to bins: fitted to the material; or one for rough lobes "
               "and four, with a cap five, for directions",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 2,
    .choices = partitions,
    .sweep = "hats,cap",
};
static const lobe_knob bins_knob = {
    .name = "bins",
    .summary = "how many bins are fitted; auto: as few as serve the material's maps as well",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 6,
    .choices = bin_numbers,
    .sweep = "1,2,3,4",
};
static const lobe_knob colour_knob = {
    .name = "colour",
    .summary = "the specular colour is the footprint's mean, or each bin has its own, for half as "
               "much memory again; auto: its own where a map says what is metal",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 2,
    .choices = colours,
    .sweep = "mean,bins",
};
static const lobe_knob least_share_knob = {
    .name = "least_share",
    .summary = "bins with less of the footprint than this are passed over",
    .maximum = 0.1,
    .initial = 1e-3,
};
static const lobe_knob storage_knob = {
    .name = "storage",
    .summary = "format of the moments; snorm16 keeps the digits of the material's own range",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 2,
    .choices = storages,
    .sweep = "float16,float32",
};
static const lobe_knob *const knobs[] = {
    &partition_knob,        &bins_knob,          &colour_knob,
    &least_share_knob,      &passes_knob_probes, &passes_knob_bias,
    &passes_knob_curvature, &storage_knob,       NULL,
};

static lobe_format format_of(const filter_context *context) {
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA16_SNORM, LOBE_FORMAT_RGBA16_FLOAT,
                                          LOBE_FORMAT_RGBA32_FLOAT};
    return formats[(int)passes_filter_setting(context, "storage")];
}

/// Whether the texels of a map lie under those of the lobes: read at the same coordinates, and no
/// finer.
static bool lies_under_lobes(const device_material *material, uint32_t map) {
    uint32_t width, height;
    const device_map *own = &material->maps[map];
    const device_map *lobes =
        &material->maps[material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH];
    passes_lobe_map_extent(material, &width, &height);
    return !own->use ||
           (own->width <= width && own->height <= height &&
            own->use->texture_coordinates == lobes->use->texture_coordinates &&
            memcmp(own->use->transform, lobes->use->transform, sizeof own->use->transform) == 0);
}

/// Whether bins have their own specular colour: if the user wants it, or else where colour and
/// width surely go together.
static bool has_bin_colour(const filter_context *context, const device_material *material) {
    enum { AUTOMATIC, MEAN };
    int wanted = (int)passes_filter_setting(context, "colour");
    if (wanted == MEAN || (wanted == AUTOMATIC && !material->metallic_varies))
        return false;
    return lies_under_lobes(material, MAP_BASE_COLOUR) &&
           lies_under_lobes(material, MAP_SPECULAR) && lies_under_lobes(material, MAP_WIDTH);
}

/// Largest value of a colour map; 1 for those of eight bits.
static float largest_texel(const lobe_scene *scene, const device_map *map) {
    const lobe_image *image = map->use ? &scene->images[map->use->image].image : NULL;
    float largest = 1, texel[4];
    for (uint32_t i = 0; image && i < image->width * image->height; ++i) {
        if (!passes_image_texel(image, i % image->width, i / image->width, texel))
            return largest;
        largest = fmaxf(largest, fmaxf(texel[0], fmaxf(texel[1], texel[2])));
    }
    return largest;
}

/// What no colour of the material's exceeds, neither a bin's nor the diffuse one.
static float largest_colour(const lobe_scene *scene, const device_material *material) {
    const lobe_material *source = material->material;
    float base = 1, specular = 1;
    for (int i = 0; i < 3; ++i) {
        base = fmaxf(base, source->base_colour[i]);
        for (uint32_t k = 0; source->model != LOBE_MATERIAL_MICROFACET && k < source->lobe_count;
             ++k)
            specular = fmaxf(specular, source->lobes[k].colour[i] /
                                           fmaxf(passes_material_lobe_share(source, k), 1e-6f));
    }
    return fmaxf(base * largest_texel(scene, &material->maps[MAP_BASE_COLOUR]),
                 specular * largest_texel(scene, &material->maps[MAP_SPECULAR]));
}

static void specialise_bins(const filter_context *context, const moment_partition *partition,
                            bool colour, filtered_appearance *appearance) {
    passes_appearance_specialise(appearance, SPECIALISE_BINS, partition->bins);
    passes_appearance_specialise(appearance, SPECIALISE_BIN_COLOUR, colour);
    passes_appearance_specialise_number(appearance, SPECIALISE_LEAST_SHARE,
                                        (float)passes_filter_setting(context, "least_share"));
}

static void build(const filter_context *context, size_t instance, filtered_appearance *appearance) {
    uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    bool binned = passes_lobe_map_extent(material, &width, &height) && width * height > 1;
    lobe_resource resource, range;
    if (binned) {
        const moment_partition *partition = passes_moment_partition_of(
            context->scene, index, (uint32_t)passes_filter_setting(context, "partition"),
            (uint32_t)passes_filter_setting(context, "bins"));
        if (!partition) {
            lobe_graph_fail(context->graph, LOBE_ERROR_OUT_OF_MEMORY,
                            "material '%s': no memory to partition its lobes",
                            material->material->name);
            return;
        }
        bool colour = has_bin_colour(context, material);
        float largest = colour ? largest_colour(context->scene->scene, material) : 1;
        moment_map moments =
            passes_moment_binning(context, index, partition, format_of(context), colour, largest);
        specialise_bins(context, partition, colour, appearance);
        appearance->bytes = passes_reduced_map_bytes(&moments.map, moments.format);
        appearance->base_texels = (uint64_t)width * height;
        resource = moments.map.resource;
        range = moments.range;
    } else {
        static const struct moment_binning_constants none;
        resource = lobe_graph_import_texture(context->graph, context->scene->white);
        range = lobe_graph_upload(context->graph, "no bins", &none, sizeof none);
    }
    uint32_t map = material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH;
    passes_appearance_bind(appearance, "moment_map", resource,
                           passes_filtered_map_sampler(material, map));
    passes_appearance_bind(appearance, "binning_block", range, (lobe_sampler){0});
    passes_appearance_specialise(appearance, SPECIALISE_MIXTURE, binned);
    passes_filtered_maps_build(context, index, appearance);
}

const lobe_filter passes_filter_moments = {
    .name = "moments",
    .summary = "moments of lobes in bins fitted to the material",
    .paper = "",
    .shading = "moments",
    .knobs = knobs,
    .build = build,
};
