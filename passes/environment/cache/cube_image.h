#ifndef PASSES_ENVIRONMENT_CUBE_IMAGE_H
#define PASSES_ENVIRONMENT_CUBE_IMAGE_H

#include <lobe/exr.h>
#include <lobe/host.h>
#include <lobe/result.h>

/// A cube map with MIP levels in host memory, in the order in which a graph reads it back: level by
/// level, and within a level face by face, +X -X +Y -Y +Z -Z, oriented as in Vulkan.
typedef struct cube_image {
    uint32_t width;  ///< texels along a face of level 0: a power of two
    uint32_t levels; ///< down to 1x1
    float *texels;   ///< four floats per texel, owned
} cube_image;

/// Allocates zeroed texels; free them with passes_cube_image_free. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result passes_cube_image_allocate(cube_image *cube, uint32_t width, const lobe_host *host);
/// Frees the texels and zeroes the structure.
void passes_cube_image_free(cube_image *cube);

/// The number of texels of all levels and faces.
size_t passes_cube_image_texels(const cube_image *cube);
/// The first texel of a face.
float *passes_cube_image_face(const cube_image *cube, uint32_t level, uint32_t face);

/// Writes an OpenEXR file of MIP levels, each with its faces below one another, oriented as
/// ImfEnvmap.h shows. Texels are spaced evenly on the faces, as on the device: their centres are
/// not on the edges. The format requires levels below that of 1x1 faces; they hold the mean of all
/// faces.
lobe_result passes_cube_image_write(const char *path, const cube_image *cube,
                                    const lobe_exr_attribute *attributes, size_t attribute_count,
                                    const lobe_host *host);

/// Reads the levels of such a file. Errors: LOBE_ERROR_MALFORMED (not a cube with levels), ...
lobe_result passes_cube_image_from(const char *path, const lobe_exr_contents *contents,
                                   const lobe_host *host, cube_image *cube);

#endif
