#include "passes/maps/colours/mirrored_luminance.h"

#include "passes/maps/moment_map.h"

bool passes_mirrored_luminance_varies(const device_material *material) {
    const lobe_material *source = material->material;
    const bool coloured_metal = material->maps[MAP_BASE_COLOUR].use && source->metallic > 0;
    return source->model == LOBE_MATERIAL_MICROFACET &&
           (material->metallic_varies || coloured_metal) && passes_bins_may_have_colours(material);
}
