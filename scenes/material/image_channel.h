#ifndef SCENES_MATERIAL_IMAGE_CHANNEL_H
#define SCENES_MATERIAL_IMAGE_CHANNEL_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// Single channels of RGBA8_UNORM, RGBA8_SRGB (as encoded) and RGBA16_UNORM images.

/// [0, 1]; `channel`: [0, 3].
double scenes_image_channel_value(const lobe_image *image, uint32_t column, uint32_t row,
                                  uint32_t channel);

/// The source of a channel of a packed image.
typedef struct image_channel {
    const lobe_image *image; ///< NULL or empty: `value` everywhere
    uint32_t channel;        ///< of `image` [0, 3]
    float value;             ///< [0, 1]
    bool inverted;           ///< one minus the channel of `image`
} image_channel;

/// Packs four channels into an RGBA8_UNORM image as wide as the widest and as high as the highest
/// of them (1 x 1 if none has an image). Smaller ones are interpolated bilinearly, repeating at the
/// edges. `name` is for messages. Errors: LOBE_ERROR_LIMIT, LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_image_channel_pack(const image_channel channels[4], const char *name,
                                      const lobe_host *host, lobe_image *packed);

/// Whether a channel is 1 in all texels, as that of missing alpha is.
bool scenes_image_channel_is_full(const lobe_image *image, uint32_t channel);

/// Replaces a channel by one minus its value.
void scenes_image_channel_invert(lobe_image *image, uint32_t channel);

#endif
