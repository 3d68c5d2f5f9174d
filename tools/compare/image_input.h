#ifndef TOOLS_COMPARE_IMAGE_INPUT_H
#define TOOLS_COMPARE_IMAGE_INPUT_H

#include <stdbool.h>

#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/result.h>

/// An image from a file, as linear RGBA32_FLOAT.
typedef struct image_input {
    lobe_image image;
    bool high_dynamic_range; ///< OpenEXR; false: PNG, decoded from sRGB
} image_input;

/// Reads an OpenEXR (its main layer, converted to the primaries of Rec. 709) or PNG file,
/// recognised by its first bytes. Free the image with lobe_image_free. Errors: those of
/// lobe_exr_read and lobe_png_read.
lobe_result image_input_read(const char *path, const lobe_host *host, image_input *input);

#endif
