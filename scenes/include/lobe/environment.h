#ifndef LOBE_ENVIRONMENT_H
#define LOBE_ENVIRONMENT_H

#include <stdbool.h>

#include <lobe/image.h>
#include <lobe/log.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Light that comes from all around, from infinitely far away: an image of the sphere.

/// How the sphere of directions is laid out on an image, in the environment's own space: +Y is up.
/// The six faces of a cube are squares of equal size; which way each lies is said in
/// scenes/environment_direction.h.
typedef enum lobe_environment_layout {
    /// The top row is +Y, the centre looks to +Z, longitude grows to the left as seen from inside:
    /// u = 0 and 1 are -Z, u = 1/4 is +X, u = 3/4 is -X.
    LOBE_ENVIRONMENT_LATITUDE_LONGITUDE,
    LOBE_ENVIRONMENT_CUBE_COLUMN,      ///< six faces below one another: +X -X +Y -Y +Z -Z
    LOBE_ENVIRONMENT_CUBE_ROW,         ///< the same beside one another
    LOBE_ENVIRONMENT_VERTICAL_CROSS,   ///< three faces wide, four high
    LOBE_ENVIRONMENT_HORIZONTAL_CROSS, ///< four faces wide, three high
} lobe_environment_layout;

/// Plain data that a host may also fill itself.
typedef struct lobe_environment {
    char *name;       ///< a file or "sky", for messages; owned
    lobe_image image; ///< RGBA32_FLOAT: linear radiance, all finite and at least 0; alpha is unused
    lobe_environment_layout layout;
    /// Turns directions of the environment's space into those of the world: a rotation, column by
    /// column, [column][row].
    float world_from_environment[3][3];
    float intensity; ///< [0, infinity): the image's radiance is multiplied by it
} lobe_environment;

/// Where a direction (of the environment's own space, of any length but 0) lies on the image, in
/// texels from its top left corner. False where the image does not have the layout's shape: whole
/// square faces.
bool lobe_environment_position(const lobe_environment *environment, const double direction[3],
                               double position[2]);

/// Frees all and clears the pointer. NULL is fine.
void lobe_environment_destroy(lobe_environment **environment);

#ifdef __cplusplus
}
#endif

#endif
