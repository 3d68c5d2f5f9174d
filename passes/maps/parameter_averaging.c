#include "passes/maps/parameter_averaging.h"

const lobe_map_kind passes_averaged_parameters = {
    .content = "averaged parameters",
    .pass = "parameter_averaging",
    .shader = "maps/parameter_averaging.comp",
    .seen_shader = "maps/parameter_averaging_seen_tiles.comp",
    .binding = "parameter_map",
    .layers = 1,
    .mask_layers = 1,
};

void passes_parameter_averaging_build(const filter_context *context, size_t instance,
                                      const void *prepared, filtered_appearance *appearance) {
    (void)prepared;
    passes_lobe_map_build(context, instance, &passes_averaged_parameters, appearance);
}
