#ifndef TOOLS_REPORT_REPORT_PICTURE_H
#define TOOLS_REPORT_REPORT_PICTURE_H

#include <stdint.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// From renderings to the pictures that the report shows.

/// Texels of an image: x, y, width, height.
typedef struct report_window {
    uint32_t x, y, width, height;
} report_window;

/// How far each texel is from the reference: the length of the difference of their RGB over the
/// root mean square of the reference's length, so that the root mean square of all texels is the
/// relative L2 error. Both images are linear RGBA32_FLOAT of one extent; `errors` becomes
/// R32_FLOAT; where the reference is black all over, none is finite. Errors:
/// LOBE_ERROR_OUT_OF_MEMORY.
lobe_result report_error_map(const lobe_image *test, const lobe_image *reference,
                             const lobe_host *host, lobe_image *errors);

/// The value that a part [0, 1] of the finite texels of some R32_FLOAT images do not exceed, to
/// within 5 %; 0 where there are none.
double report_quantile(const lobe_image *images, size_t count, double part);

/// A tone-mapped picture, each block of `factor` x `factor` texels averaged as a screen would
/// show it from farther away. `picture` becomes RGBA8_SRGB. Errors: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result report_show(const lobe_image *linear, uint32_t factor, const lobe_host *host,
                        lobe_image *picture);

/// A heat map of errors up to `scale`, each block averaged likewise.
lobe_result report_show_errors(const lobe_image *errors, double scale, uint32_t factor,
                               const lobe_host *host, lobe_image *picture);

/// A part of a linear picture, tone-mapped.
lobe_result report_show_window(const lobe_image *linear, const report_window *window,
                               const lobe_host *host, lobe_image *picture);

/// The window of an extent, of those that begin at multiples of half of it, where the sum of some
/// error maps of one extent is greatest.
report_window report_worst_window(const lobe_image *errors, size_t count, uint32_t width,
                                  uint32_t height);

#endif
