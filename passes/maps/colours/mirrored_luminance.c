#include "passes/maps/colours/mirrored_luminance.h"

#include "passes/upload/material_maps.h"

bool passes_mirrored_luminance_varies(const device_material *material) {
    const lobe_material *source = material->material;
    const bool coloured_metal = material->maps[MAP_BASE_COLOUR].use && source->metallic > 0;
    return source->model == LOBE_MATERIAL_MICROFACET &&
           (material->metallic_varies || coloured_metal) &&
           passes_colours_lie_under_lobes(material);
}
