#include "passes/maps/moment_map.h"

#include "passes/context/knob_values.h"
#include "passes/maps/filtered_maps.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/moment_bins.h"
#include "shaders/interface/specialisation.h"

static const char *const storages[] = {"snorm16", "float16", "float32", NULL};

const filter_knob passes_knob_least_share = {
    .description = {.name = "least_share",
                    .summary = "bins with a smaller share of the footprint are skipped",
                    .maximum = 0.1,
                    .initial = 1e-3},
    .feeds = KNOB_FEEDS_FILTER(moments_knobs, least_share),
};
const filter_knob passes_knob_bin_storage = {
    .description =
        {.name = "storage",
         .summary = "format of the moments; snorm16 keeps the digits of the material's own range",
         .kind = LOBE_KNOB_CHOICE,
         .maximum = 2,
         .choices = storages,
         .sweep = "float16,float32"},
};

lobe_format passes_bin_format(const filter_context *context) {
    static const lobe_format formats[] = {LOBE_FORMAT_RGBA16_SNORM, LOBE_FORMAT_RGBA16_FLOAT,
                                          LOBE_FORMAT_RGBA32_FLOAT};
    return formats[(int)passes_knob_choice(context, &passes_knob_bin_storage)];
}

bool passes_bin_widths_vary(const device_material *material) {
    const lobe_material *source = material->material;
    bool vary = material->maps[MAP_WIDTH].use != NULL;
    for (uint32_t i = 1; source->model != LOBE_MATERIAL_MICROFACET && i < source->lobe_count; i++)
        vary |= source->lobes[i].width != source->lobes[0].width;
    return vary;
}

uint32_t passes_bin_layers(const device_material *material, uint32_t bins, bool own_colours) {
    const uint32_t last = own_colours || passes_lobes_are_masked(material) ? 1 : 0;
    return (own_colours ? 3 : 2) * bins + last;
}

void passes_bins_specialise(const device_material *material, uint32_t bins, bool own_colours,
                            filtered_appearance *appearance) {
    passes_appearance_specialise(appearance, SPECIALISE_BIN_WIDTHS,
                                 passes_bin_widths_vary(material));
    passes_appearance_specialise(appearance, SPECIALISE_BINS, bins);
    passes_appearance_specialise(appearance, SPECIALISE_BIN_COLOUR, own_colours);
}

void passes_bin_appearance_bind(const filter_context *context, uint32_t material,
                                const moment_map *moments, filtered_appearance *appearance) {
    static const struct moment_binning_constants none;
    const lobe_resource bins =
        moments ? moments->bins : lobe_graph_upload(context->graph, "no bins", &none, sizeof none);
    passes_lobe_map_bind(context, material, "moment_map", moments ? &moments->map : NULL,
                         moments ? moments->format : LOBE_FORMAT_RGBA16_SNORM, appearance);
    passes_appearance_bind(appearance, "binning_block", bins, (lobe_sampler){0});
}

void passes_bin_texels_bind(const filter_context *context, uint32_t material,
                            const moment_map *moments, filtered_appearance *appearance) {
    const device_material *uploaded = &context->scene->materials[material];
    lobe_sampler sampler =
        passes_filtered_map_sampler(context, uploaded, passes_lobe_grid(uploaded).map);
    sampler.texels = sampler.levels = LOBE_SAMPLE_NEAREST;
    const lobe_resource texels =
        moments ? moments->map.resource
                : lobe_graph_import_texture(context->graph, context->scene->white);
    passes_appearance_bind(appearance, "moment_texels", texels, sampler);
    passes_appearance_bind(appearance, "likeness_map",
                           moments && moments->likeness.version ? moments->likeness : texels,
                           sampler);
}
