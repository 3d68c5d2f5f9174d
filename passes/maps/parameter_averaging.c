#include "passes/maps/parameter_averaging.h"

#include "passes/maps/lobe_map.h"
#include "shaders/interface/mixture.h"
#include "shaders/interface/specialisation.h"

static const lobe_map_kind averaged_parameters = {
    .content = "averaged parameters",
    .pass = "parameter_averaging",
    .shader = "maps/parameter_averaging.comp",
    .binding = "parameter_map",
    .layers = 1,
    .presence_id = SPECIALISE_MIXTURE,
};

reduced_map passes_parameter_averaging(const filter_context *context, uint32_t material) {
    return passes_lobe_map(context, material, &averaged_parameters);
}

void passes_parameter_averaging_build(const filter_context *context, size_t instance,
                                      const void *prepared, filtered_appearance *appearance) {
    (void)prepared;
    passes_lobe_map_build(context, instance, &averaged_parameters, appearance);
}
