#ifndef PASSES_UPLOAD_COLOURS_MATERIAL_COLOURS_H
#define PASSES_UPLOAD_COLOURS_MATERIAL_COLOURS_H

#include "passes/upload/device_scene.h"

/// Colours of a texel of a material's lobe_grid, on the host, linear RGB: those of its maps,
/// without the factor of the base colour, so that what is made of them does not depend on it.
typedef struct material_colours {
    double albedo[3];
    double metallic;    ///< [0, 1]; 0 for half-vector lobes
    double specular[3]; ///< of microfacets F0; of half-vector lobes the factor of their colours
} material_colours;

/// Reads the maps at the texels that lie under a texel of the grid. False if a map has a format
/// that the host does not read (half floats).
bool passes_material_colours_read(const lobe_scene *scene, const device_material *material,
                                  uint32_t x, uint32_t y, material_colours *colours);

/// F0 of microfacets: 4 % of what is not metal (glTF 2.0, appendix B.2).
double passes_reflectance_of(double albedo, double metallic);

#endif
