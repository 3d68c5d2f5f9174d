#ifndef PASSES_ENVIRONMENT_CUBE_IMAGE_H
#define PASSES_ENVIRONMENT_CUBE_IMAGE_H

#include <lobe/exr.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// A cube map with MIP levels in host memory, in the order in which a graph delivers it: level
/// after level, in a level face after face, +X -X +Y -Y +Z -Z, oriented as Vulkan's.
typedef struct cube_image {
    uint32_t width;  ///< texels along a face of level 0: a power of two
    uint32_t levels; ///< down to 1x1
    float *texels;   ///< four a texel, owned
} cube_image;

/// Zeroed texels; free it with passes_cube_image_free. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result passes_cube_image_allocate(cube_image *cube, uint32_t width, const lobe_host *host);
/// Frees the texels and zeroes the structure.
void passes_cube_image_free(cube_image *cube);

/// Texels of all levels and faces.
size_t passes_cube_image_texels(const cube_image *cube);
/// The first texel of a face.
float *passes_cube_image_face(const cube_image *cube, uint32_t level, uint32_t face);

/// Writes an OpenEXR file of MIP levels with faces below one another, oriented as ImfEnvmap.h
/// shows. Texels lie as on the device, evenly on the faces: their centres are not on the edges.
/// Below the level of 1x1 faces the format asks for more, which hold the mean of all.
lobe_result passes_cube_image_write(const char *path, const cube_image *cube,
                                    const lobe_exr_attribute *attributes, size_t attribute_count,
                                    const lobe_host *host);

/// The levels of such a file. Errors: LOBE_ERROR_MALFORMED where they are none of a cube, ...
lobe_result passes_cube_image_from(const char *path, const lobe_exr_contents *contents,
                                   const lobe_host *host, cube_image *cube);

#endif
