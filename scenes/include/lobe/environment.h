#ifndef LOBE_ENVIRONMENT_H
#define LOBE_ENVIRONMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/file.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Light from all directions, from infinitely far away: an image of the sphere.

/// The layout of the sphere of directions on an image, in the environment's own space: +Y is up.
///
/// Positions are in texels: x to the right, y downwards, (0, 0) is the image's top left corner and
/// texel (i, j) covers [i, i + 1] x [j, j + 1], so that its middle is (i + 0.5, j + 0.5).
///
/// Latitude and longitude: longitude = atan2(x, z) = (1/2 - u) 2 pi and latitude = asin(y) =
/// (1/2 - v) pi, where (u, v) = position / extent. (OpenEXR puts the middles of the outermost
/// texels on the poles and on -Z; like most programs, lobe spreads the texels evenly instead.)
///
/// Cubes: on a face, the direction of the point (s, t), both in [-1, 1], s to the right and t
/// downwards, is forward + s right + t down. Pictures are never mirrored: right = forward x up, as
/// for someone inside the cube who looks at the face.
///
///     face  | column, row (as OpenEXR) | crosses, which fold along the edges that touch
///           | right   down             | right   down
///     +X    |  +Z      -Y              |  +Z      -Y
///     -X    |  -Z      -Y              |  -Z      -Y
///     +Y    |  +X      -Z              |  -X      +Z
///     -Y    |  +X      +Z              |  -X      -Z
///     +Z    |  -X      -Y              |  -X      -Y
///     -Z    |  +X      -Y              |  +X      -Y (horizontal), -X  +Y (vertical)
///
/// Where the faces lie:
///
///     column: +X    row: +X -X +Y -Y +Z -Z    vertical cross:      +Y
///             -X                                                +X +Z -X
///             +Y    horizontal cross:    +Y                        -Y
///             -Y                      +X +Z -X -Z                  -Z
///             +Z                         -Y
///             -Z
typedef enum lobe_environment_layout {
    /// The top row is +Y, the centre looks to +Z, longitude grows to the left as seen from inside:
    /// u = 0 and 1 are -Z, u = 1/4 is +X, u = 3/4 is -X.
    LOBE_ENVIRONMENT_LATITUDE_LONGITUDE,
    LOBE_ENVIRONMENT_CUBE_COLUMN,      ///< six faces, one below the other: +X -X +Y -Y +Z -Z
    LOBE_ENVIRONMENT_CUBE_ROW,         ///< the same, side by side
    LOBE_ENVIRONMENT_VERTICAL_CROSS,   ///< three faces wide, four high
    LOBE_ENVIRONMENT_HORIZONTAL_CROSS, ///< four faces wide, three high
} lobe_environment_layout;

/// Plain data that a host may also fill itself. If lobe is to free it, allocate all of it (the
/// structure, the name, the texels) with lobe_allocate.
typedef struct lobe_environment {
    char *name;       ///< a file or "sky", for messages; owned
    lobe_image image; ///< RGBA32_FLOAT: linear radiance, all finite and at least 0; alpha is unused
    lobe_environment_layout layout;
    /// Rotates directions from the environment's space to the world: column by column,
    /// [column][row].
    float world_from_environment[3][3];
    float intensity; ///< [0, infinity): multiplies the image's radiance
} lobe_environment;

/// The position on the image of a direction (in the environment's own space, of any length but 0),
/// in texels from the top left corner. False if the image does not have the shape of the layout:
/// whole square faces.
LOBE_API bool lobe_environment_position(const lobe_environment *environment,
                                        const double direction[3], double position[2]);

/// Largest width or height in texels of an image that lobe_environment_open returns.
#define LOBE_ENVIRONMENT_MAXIMUM_EXTENT 16384u

/// What to open, and from where.
typedef struct lobe_environment_open_parameters {
    const char *environment; ///< the path of a file, or "sky"
    /// A whole file in memory; `environment` is then only its name in messages. Needed only during
    /// the call. NULL: none.
    const void *data;
    size_t size; ///< bytes of `data`
    /// Where to read the file. NULL: in the file system. Needed only during the call.
    const lobe_file_source *files;
} lobe_environment_open_parameters;

/// Opens an image of all directions, or the sky.
///
/// - A file: OpenEXR (its main layer) or a Radiance picture (.hdr), recognised by content. The
///   attribute "envmap" of an OpenEXR file is trusted; otherwise the shape decides: 1:6 and 6:1 are
///   columns and rows of six faces, 3:4 and 4:3 crosses, and anything from 1:1 to 4:1 is latitude
///   and longitude (with a notice unless it is 2:1). Its colours are converted from the primaries
///   that the file states ("chromaticities", "PRIMARIES=").
/// - "sky": a clear sky with a sun (Preetham, Shirley, Smits 1999), 40 degrees high, to the left
///   behind a viewer who looks along -Z, over grey ground. A white level surface under it has a
///   luminance of 1. A file of that name is "./sky".
///
/// Impossible radiance is repaired, with one warning that counts it: negative numbers become 0, NaN
/// and infinity become the mean of the finite numbers around them. Images finer than a cube with
/// faces of 2048 texels needs, or larger than LOBE_ENVIRONMENT_MAXIMUM_EXTENT, are halved without
/// losing light, with a notice.
///
/// On failure `*environment` is NULL and the log has one message that names the file and the cause.
/// Errors: LOBE_ERROR_NOT_FOUND, _READ, _MALFORMED, _UNSUPPORTED (another format, or no known
/// shape), _LIMIT, _OUT_OF_MEMORY.
LOBE_API lobe_result lobe_environment_open_with(const lobe_environment_open_parameters *parameters,
                                                const lobe_host *host,
                                                lobe_environment **environment);

/// The same, from the file system.
LOBE_API lobe_result lobe_environment_open(const char *file_or_sky, const lobe_host *host,
                                           lobe_environment **environment);

/// Halves the image, or each of its faces, until neither its width nor its height exceeds this
/// limit, for devices with little memory: [8, 65535] texels. The light from each part of the sphere
/// stays the same.
LOBE_API void lobe_environment_shrink(lobe_environment *environment, uint32_t maximum_extent);

/// Turns the environment about the world's +Y, counter-clockwise as seen from above, in addition to
/// its current rotation.
LOBE_API void lobe_environment_turn(lobe_environment *environment, double degrees);

/// Frees everything and clears the pointer. NULL is allowed.
LOBE_API void lobe_environment_destroy(lobe_environment **environment);

#ifdef __cplusplus
}
#endif

#endif
