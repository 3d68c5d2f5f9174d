#ifndef LOBE_COLOUR_H
#define LOBE_COLOUR_H

#include <stdbool.h>
#include <stdint.h>

#include <lobe/api.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// From scene-referred linear RGB (Rec. 709 primaries, white point D65) to pictures for a display.

/// The sRGB curve of IEC 61966-2-1: linear below 0.0031308, a power of 1/2.4 above. Maps [0, 1] to
/// [0, 1]; values outside are clamped, NaN becomes 0.
LOBE_API float lobe_srgb_encode(float linear);
/// The inverse; maps [0, 1] to [0, 1] and clamps in the same way.
LOBE_API float lobe_srgb_decode(float encoded);

/// Luminance of linear RGB, Rec. 709 (rounded to four digits): 0.2126 R + 0.7152 G + 0.0722 B.
LOBE_API float lobe_luminance(const float rgb[3]);

/// Converts linear RGB in an RGBA32_FLOAT image from other primaries. `chromaticities` are CIE x
/// and y of red, green, blue and white, which is adapted to D65 (Bradford). Of colours that Rec.
/// 709 cannot show, negative channels become 0, unless they had some before. Texels with infinite
/// channels and NaN stay as they are. False, and nothing is changed, for another format and for
/// primaries that span no colours.
LOBE_API bool lobe_image_to_rec709(lobe_image *image, const float chromaticities[4][2]);

typedef enum lobe_tone_map {
    /// Keeps values up to half of the maximum and rolls off above, so that no highlight is clipped:
    /// with m the largest channel, m' = m for m <= 1/2, else m' = 1 - 1/(4 m). All channels are
    /// scaled by m'/m, which keeps the hue.
    LOBE_TONE_MAP_SHOULDER,
    LOBE_TONE_MAP_NONE, ///< clamp each channel to [0, 1]
} lobe_tone_map;

typedef struct lobe_display_parameters {
    float exposure; ///< stops: radiance is multiplied by 2^exposure before the tone map
    lobe_tone_map tone_map;
    bool keep_alpha; ///< false: the picture is opaque
} lobe_display_parameters;

/// Converts a linear RGBA32_FLOAT image into an RGBA8_SRGB picture of the same extent: exposure,
/// tone map, sRGB curve, rounding to nearest. Negative and NaN channels become 0, infinite ones the
/// largest finite value.
/// With `keep_alpha`, the colour is premultiplied in `linear` and straight in `picture`, as in PNG.
/// `parameters` may be NULL: the defaults. `picture` is overwritten; free it with lobe_image_free.
/// Errors: LOBE_ERROR_INVALID_ARGUMENT (another format), LOBE_ERROR_OUT_OF_MEMORY.
LOBE_API lobe_result lobe_display_encode(const lobe_image *linear,
                                         const lobe_display_parameters *parameters,
                                         const lobe_host *host, lobe_image *picture);

/// Colour of a value [0, 1] in heat maps (clamped; NaN is black), as sRGB-encoded bytes: from near
/// black through violet, red and orange to pale yellow. Equal steps of the value look about equally
/// large, and lightness increases with the value, so the map still works with colour blindness and
/// in greyscale print.
LOBE_API void lobe_heat_colour(float value, uint8_t srgb[3]);

#ifdef __cplusplus
}
#endif

#endif
