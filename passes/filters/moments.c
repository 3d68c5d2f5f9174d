#include "passes/filtered_maps.h"
#include "passes/filters/filters.h"
#include "passes/moment_binning.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/specialisation.h"

static const char *const partitions[] = {"fitted", "hats", "cap", NULL};
static const char *const bin_numbers[] = {"auto", "1", "2", "3", "4", "5", "6", NULL};
static const char *const colours[] = {"mean", "bins", NULL};
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
               "much memory again",
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 1,
    .choices = colours,
    .sweep = "bins",
};
static const lobe_knob least_share_knob = {
    .name = "least_share",
    .summary = "bins with less of the footprint than this are passed over",
    .maximum = 0.1,
    .initial = 1e-4,
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
    &partition_knob, &bins_knob,    &colour_knob, &least_share_knob, &knob_probes, &knob_bias,
    &knob_curvature, &storage_knob, NULL,
};

static lobe_format format_of(const filter_context *context) {
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA16_SNORM, LOBE_FORMAT_RGBA16_FLOAT,
                                          LOBE_FORMAT_RGBA32_FLOAT};
    return formats[(int)filter_setting(context, "storage")];
}

/// Whether texels of the specular colour can be read beside those of the lobes.
static bool has_bin_colour(const filter_context *context, const device_material *material) {
    return filter_setting(context, "colour") != 0 && material->map_bits != 0;
}

static void specialise_bins(const filter_context *context, const moment_partition *partition,
                            bool colour, float colour_scale, filtered_appearance *appearance) {
    appearance_specialise(appearance, SPECIALISE_BINS, partition->bins);
    appearance_specialise(appearance, SPECIALISE_BIN_COLOUR, colour);
    appearance_specialise_number(appearance, SPECIALISE_ORIGIN_X, partition->origin[0]);
    appearance_specialise_number(appearance, SPECIALISE_ORIGIN_Y, partition->origin[1]);
    appearance_specialise_number(appearance, SPECIALISE_RANGE, partition->range);
    appearance_specialise_number(appearance, SPECIALISE_MASS_SCALE, partition->mass_scale);
    appearance_specialise_number(appearance, SPECIALISE_SHARP_SCALE, partition->sharp_scale);
    appearance_specialise_number(appearance, SPECIALISE_COLOUR_SCALE, colour_scale);
    appearance_specialise_number(appearance, SPECIALISE_LEAST_SHARE,
                                 (float)filter_setting(context, "least_share"));
}

static void build(const filter_context *context, size_t instance, filtered_appearance *appearance) {
    uint32_t index = context->scene->instances[instance].material;
    const device_material *material = &context->scene->materials[index];
    uint32_t width, height;
    bool binned = lobe_map_extent(material, &width, &height) && width * height > 1;
    lobe_resource resource;
    if (binned) {
        const moment_partition *partition = moment_partition_of(
            context->scene, index, (uint32_t)filter_setting(context, "partition"),
            (uint32_t)filter_setting(context, "bins"));
        bool colour = has_bin_colour(context, material);
        moment_map moments =
            moment_binning(context, index, partition, format_of(context), colour, 1);
        specialise_bins(context, partition, colour, 1, appearance);
        appearance->bytes = reduced_map_bytes(&moments.map, moments.format);
        appearance->base_texels = (uint64_t)width * height;
        resource = moments.map.resource;
    } else {
        resource = lobe_graph_import_texture(context->graph, context->scene->white);
    }
    uint32_t map = material->maps[MAP_NORMAL].use ? MAP_NORMAL : MAP_WIDTH;
    appearance_bind(appearance, "moment_map", resource, filtered_map_sampler(material, map));
    appearance_specialise(appearance, SPECIALISE_MIXTURE, binned);
    filtered_maps_build(context, index, appearance);
}

const lobe_filter filter_moments = {
    .name = "moments",
    .summary = "moments of lobes in bins fitted to the material",
    .paper = "",
    .shading = "moments",
    .knobs = knobs,
    .build = build,
};
