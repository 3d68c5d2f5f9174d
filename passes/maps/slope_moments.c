#include "passes/maps/slope_moments.h"

#include "passes/maps/lobe_map.h"
#include "shaders/interface/slope_moments.h"

static const lobe_map_kind slope_moments = {
    .content = "slope moments",
    .pass = "slope_moments",
    .shader = "maps/slope_moments.comp",
    .binding = "moment_map",
    .layers = SLOPE_LAYERS,
    .presence_id = SPECIALISE_SLOPES,
};

reduced_map passes_slope_moments(const filter_context *context, uint32_t material) {
    return passes_lobe_map(context, material, &slope_moments);
}

void passes_slope_moments_build(const filter_context *context, size_t instance,
                                const void *prepared, filtered_appearance *appearance) {
    (void)prepared;
    passes_lobe_map_build(context, instance, &slope_moments, appearance);
}
