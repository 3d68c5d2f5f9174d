#ifndef TESTS_REFERENCE_MIXTURE_LAYERS_H
#define TESTS_REFERENCE_MIXTURE_LAYERS_H

#include <stdint.h>

/// An array of images of four doubles per texel, for data that the device keeps in texture arrays.
typedef struct reference_layers {
    uint32_t width, height, layers;
    double *texels; ///< [layer][row][column][channel]
} reference_layers;

/// Zeroes. Aborts if memory runs out.
reference_layers reference_layers_allocate(uint32_t width, uint32_t height, uint32_t layers);
void reference_layers_free(reference_layers *layers);

/// Four doubles, to read and write.
double *reference_texel(const reference_layers *layers, uint32_t x, uint32_t y, uint32_t layer);

#endif
