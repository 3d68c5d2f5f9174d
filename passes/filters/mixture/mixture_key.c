#include "passes/filters/mixture/mixture_key.h"

#include "passes/context/digest.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/maps/kept/texels.h"
#include "passes/maps/lobe_map.h"
#include "passes/upload/device_scene_parts.h"
#include "passes/upload/material_maps.h"

uint64_t passes_mixture_kind_digest(const filter_context *context, const mixture_kind *kind) {
    uint64_t digest = passes_digest_bytes(MIXTURE_FILE_VERSION, &kind->prior, sizeof kind->prior);
    digest = passes_digest_bytes(digest, &kind->least_gain, sizeof kind->least_gain);
    const uint64_t numbers[] = {kind->components,
                                kind->steps,
                                kind->plane,
                                kind->start,
                                kind->own_steps,
                                kind->shape,
                                kind->is_printed,
                                kind->own_colours,
                                (uint64_t)kind->format,
                                passes_knob_choice(context, &passes_knob_base)};
    return passes_digest_bytes(digest, numbers, sizeof numbers);
}

/// The maps that samples are made from, by MAP_...
static bool is_read(const device_material *material, uint32_t map, bool own_colours) {
    const bool is_colour = map == MAP_BASE_COLOUR || map == MAP_SPECULAR;
    return material->maps[map].use &&
           (map == MAP_NORMAL || map == MAP_WIDTH || (own_colours && is_colour) ||
            (map == MAP_BASE_COLOUR && passes_lobes_are_masked(material)));
}

static uint64_t constants_digest(const filter_context *context, const device_material *material,
                                 bool own_colours, uint64_t digest) {
    const struct lobe_grid_constants grid = passes_lobe_grid_constants(context, material);
    struct material_constants constants = material->values;
    if (!own_colours)
        passes_device_material_forget_colours(&constants);
    digest = passes_digest_bytes(digest, &grid, sizeof grid);
    return passes_digest_bytes(digest, &constants, sizeof constants);
}

uint64_t passes_mixture_inputs(const filter_context *context, const device_material *material,
                               bool own_colours) {
    uint64_t digest = constants_digest(context, material, own_colours, material->parameter_version);
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, map, own_colours))
            digest = passes_digest(digest, material->texel_versions[map]);
    return digest;
}

bool passes_mixture_has_texels(const filter_context *context, const device_material *material,
                               bool own_colours) {
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, map, own_colours) &&
            !passes_kept_has_texels(context, &material->maps[map]))
            return false;
    return true;
}

uint64_t passes_mixture_key(const filter_context *context, const device_material *material,
                            const mixture_kind *kind) {
    uint64_t digest = passes_mixture_kind_digest(context, kind);
    digest = constants_digest(context, material, kind->own_colours, digest);
    specialisation_list list = {.graph = context->graph};
    passes_base_maps_specialise(material, &list);
    for (size_t i = 0; i < list.count; i++)
        digest = passes_digest(digest, (uint64_t)list.items[i].id << 32 | list.items[i].bits);
    for (uint32_t map = 0; map < MAP_COUNT; map++)
        if (is_read(material, map, kind->own_colours))
            digest = passes_kept_map_digest(&material->maps[map], passes_digest(digest, map));
    return digest;
}
