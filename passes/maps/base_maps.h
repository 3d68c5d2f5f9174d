#ifndef PASSES_MAPS_BASE_MAPS_H
#define PASSES_MAPS_BASE_MAPS_H

#include "passes/filters/filter.h"

/// Binds what shaders/maps/base_maps.glsl reads: a material's constants, normal and width map.
/// `colours`: the shader reads colours and metal of the constants too, and depends on them.
void passes_base_maps_read(const filter_context *context, const device_material *material,
                           bool colours, lobe_pass *pass);

#endif
