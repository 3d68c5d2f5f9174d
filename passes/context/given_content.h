#ifndef PASSES_CONTEXT_GIVEN_CONTENT_H
#define PASSES_CONTEXT_GIVEN_CONTENT_H

#include "passes/context/filter.h"

/// Lets the host give the texels of images and the vertices of meshes that are on the device, and
/// the maps of waves; fails the frame if it does not. `give`: NULL: nobody does.
void passes_given_content_take(const filter_context *context, lobe_content_giver give, void *giver);
/// The same without vertices.
void passes_given_maps_take(const filter_context *context, lobe_content_giver give, void *giver);

#endif
