#ifndef TESTS_PASSES_FILTERS_MIXTURE_CHANGING_MATERIALS_H
#define TESTS_PASSES_FILTERS_MIXTURE_CHANGING_MATERIALS_H

#include <lobe/image.h>

/// Maps made here whose relief, sharpness and colour change together over the map.

enum { CHANGING_MATERIALS = 26 };

/// Which of them.
extern const char *const changing_material_names[CHANGING_MATERIALS];

/// A square map of RGBA32_FLOAT: normals as (n + 1) / 2, and the concentration of the base lobe.
/// `colours`: of R32_FLOAT, in (0, 1]. Both to free by the caller.
lobe_image changing_material(int which, uint32_t extent, lobe_image *colours);

#endif
