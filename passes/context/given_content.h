#ifndef PASSES_CONTEXT_GIVEN_CONTENT_H
#define PASSES_CONTEXT_GIVEN_CONTENT_H

#include "passes/context/filter.h"

/// Lets the host give the texels of images and the vertices of meshes that are on the device; fails
/// the frame if it does not. `give`: NULL: nobody does.
void passes_given_content_take(const filter_context *context, lobe_content_giver give, void *giver);
/// The same of images alone.
void passes_given_images_take(const filter_context *context, lobe_content_giver give, void *giver);

#endif
