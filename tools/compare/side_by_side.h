#ifndef TOOLS_COMPARE_SIDE_BY_SIDE_H
#define TOOLS_COMPARE_SIDE_BY_SIDE_H

#include <stddef.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// One of several pictures: each under a caption bar, and below it its errors, if any, as a heat
/// map under another caption bar (otherwise the scale of the heat maps).

typedef struct side_by_side_panel {
    const char *caption;       ///< in at most four lines, by the width of the panel
    const lobe_image *picture; ///< RGBA8_SRGB
    const char *error_caption;
    const lobe_image *errors; ///< R32_FLOAT of the picture's extent; NULL: none
} side_by_side_panel;

typedef struct side_by_side_parameters {
    uint32_t columns;          ///< panels side by side; 0: all
    uint32_t zoom;             ///< each texel becomes zoom x zoom; 0 means 1
    float error_magnification; ///< errors are multiplied by it; 1 is the brightest; 0 means 1
} side_by_side_parameters;

/// All panels have the same extent. `parameters` may be NULL. `picture` becomes RGBA8_SRGB; free it
/// with lobe_image_free. Errors: LOBE_ERROR_INVALID_ARGUMENT (no panel, another format, differing
/// extents), LOBE_ERROR_LIMIT (the result is too large), LOBE_ERROR_OUT_OF_MEMORY.
lobe_result side_by_side_compose(const side_by_side_panel *panels, size_t count,
                                 const side_by_side_parameters *parameters, const lobe_host *host,
                                 lobe_image *picture);

#endif
