#include "passes/maps/slope_moments.h"

#include "shaders/interface/slope_moments.h"

const lobe_map_kind passes_slope_moments = {
    .content = "slope moments",
    .pass = "slope_moments",
    .shader = "maps/slope_moments.comp",
    .seen_shader = "maps/slope_moments_seen_tiles.comp",
    .binding = "moment_map",
    .layers = SLOPE_LAYERS,
};

void passes_slope_moments_build(const filter_context *context, size_t instance,
                                const void *prepared, filtered_appearance *appearance) {
    (void)prepared;
    passes_lobe_map_build(context, instance, &passes_slope_moments, appearance);
}
