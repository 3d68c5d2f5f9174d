#ifndef PASSES_ENVIRONMENT_CUBE_FILE_H
#define PASSES_ENVIRONMENT_CUBE_FILE_H

#include <lobe/exr.h>
#include <lobe/log.h>
#include <lobe/result.h>

/// A cube map with MIP levels in host memory, in the order in which a graph delivers it: level
/// after level, in a level face after face, +X -X +Y -Y +Z -Z, oriented as Vulkan's.
typedef struct environment_cube {
    uint32_t width;  ///< texels along a face of level 0: a power of two
    uint32_t levels; ///< down to 1x1
    float *texels;   ///< four a texel, owned
} environment_cube;

/// Zeroed texels; free it with environment_cube_free. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result environment_cube_allocate(environment_cube *cube, uint32_t width, const lobe_log *log);
/// Frees the texels and zeroes the structure.
void environment_cube_free(environment_cube *cube);

/// Texels of all levels and faces.
size_t environment_cube_texels(const environment_cube *cube);
/// The first texel of a face.
float *environment_cube_face(const environment_cube *cube, uint32_t level, uint32_t face);

/// Writes an OpenEXR file of MIP levels with faces below one another, oriented as ImfEnvmap.h
/// shows. Texels lie as on the device, evenly on the faces: their centres are not on the edges.
/// Below the level of 1x1 faces the format asks for more, which hold the mean of all.
lobe_result environment_cube_write(const char *path, const environment_cube *cube,
                                   const lobe_exr_attribute *attributes, size_t attribute_count,
                                   const lobe_log *log);

/// The levels of such a file. Errors: LOBE_ERROR_MALFORMED where they are none of a cube, ...
lobe_result environment_cube_from(const char *path, const lobe_exr_contents *contents,
                                  const lobe_log *log, environment_cube *cube);

#endif
