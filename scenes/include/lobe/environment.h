#ifndef LOBE_ENVIRONMENT_H
#define LOBE_ENVIRONMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/file.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Light that comes from all around, from infinitely far away: an image of the sphere.

/// How the sphere of directions is laid out on an image, in the environment's own space: +Y is up.
/// The six faces of a cube are squares of equal size; which way each lies is said in
/// scenes/environment/direction.h.
typedef enum lobe_environment_layout {
    /// The top row is +Y, the centre looks to +Z, longitude grows to the left as seen from inside:
    /// u = 0 and 1 are -Z, u = 1/4 is +X, u = 3/4 is -X.
    LOBE_ENVIRONMENT_LATITUDE_LONGITUDE,
    LOBE_ENVIRONMENT_CUBE_COLUMN,      ///< six faces below one another: +X -X +Y -Y +Z -Z
    LOBE_ENVIRONMENT_CUBE_ROW,         ///< the same beside one another
    LOBE_ENVIRONMENT_VERTICAL_CROSS,   ///< three faces wide, four high
    LOBE_ENVIRONMENT_HORIZONTAL_CROSS, ///< four faces wide, three high
} lobe_environment_layout;

/// Plain data that a host may also fill itself. Of one that lobe is to free, all comes from
/// lobe_allocate: the structure, the name, the texels.
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

/// Largest width or height of an image that lobe_environment_open gives, in texels.
#define LOBE_ENVIRONMENT_MAXIMUM_EXTENT 16384u

/// What is opened.
typedef struct lobe_environment_open_parameters {
    const char *environment; ///< the path of a file, or "sky"
    /// A whole file in memory, which `environment` then only names, in messages. Needed during the
    /// call only. NULL: none.
    const void *data;
    size_t size; ///< bytes of `data`
    /// Where to read the file. NULL: in the file system. Needed during the call only.
    const lobe_file_source *files;
} lobe_environment_open_parameters;

/// Opens an image of all directions, or makes one by code.
///
/// - A file: OpenEXR (its main layer) or a Radiance picture (.hdr), told apart by content. What an
///   OpenEXR file's attribute "envmap" says is believed; else the shape tells: 1:6 and 6:1 are
///   columns and rows of six faces, 3:4 and 4:3 crosses, and what is between once and four times
///   as wide as high is latitude and longitude (with a notice where it is not 2:1).
/// - "sky": a clear sky with a sun (Preetham, Shirley, Smits 1999), 40 degrees high, to the left
///   behind somebody who looks along -Z, over grey ground. A white level surface under it has a
///   luminance of 1. A file of that name is "./sky".
///
/// Numbers that no light has are repaired, with one warning that counts them: negative ones become
/// 0, NaN and infinite ones the mean of the finite ones around them. Images finer than a cube of
/// 2048 texels a face needs, or larger than LOBE_ENVIRONMENT_MAXIMUM_EXTENT, are halved, with a
/// notice; no light is lost.
///
/// On failure `*environment` is NULL and the log has one line that names the file and the cause.
/// Errors: LOBE_ERROR_NOT_FOUND, _READ, _MALFORMED, _UNSUPPORTED (another format, or no known
/// shape), _LIMIT, _OUT_OF_MEMORY.
lobe_result lobe_environment_open_with(const lobe_environment_open_parameters *parameters,
                                       const lobe_host *host, lobe_environment **environment);

/// The same, from the file system.
lobe_result lobe_environment_open(const char *file_or_sky, const lobe_host *host,
                                  lobe_environment **environment);

/// Halves the image, or each of its faces, until neither its width nor its height is above this,
/// for devices that hold less: [8, 65535] texels. The light from each part of the sphere stays as
/// it was.
void lobe_environment_shrink(lobe_environment *environment, uint32_t maximum_extent);

/// Turns the environment about the world's +Y, counter-clockwise as seen from above, in addition to
/// what it is turned already.
void lobe_environment_turn(lobe_environment *environment, double degrees);

/// Frees all and clears the pointer. NULL is fine.
void lobe_environment_destroy(lobe_environment **environment);

#ifdef __cplusplus
}
#endif

#endif
