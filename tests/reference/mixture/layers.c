#include "tests/reference/mixture/layers.h"

#include <stddef.h>
#include <stdlib.h>

reference_layers reference_layers_allocate(uint32_t width, uint32_t height, uint32_t layers) {
    reference_layers made = {width, height, layers, NULL};
    made.texels = calloc((size_t)width * height * layers, 4 * sizeof(double));
    if (!made.texels)
        abort();
    return made;
}

void reference_layers_free(reference_layers *layers) {
    free(layers->texels);
    *layers = (reference_layers){0};
}

double *reference_texel(const reference_layers *layers, uint32_t x, uint32_t y, uint32_t layer) {
    size_t index = ((size_t)layer * layers->height + y) * layers->width + x;
    return layers->texels + 4 * index;
}
