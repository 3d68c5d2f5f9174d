#ifndef TESTS_PASSES_SUPPORT_PICTURE_H
#define TESTS_PASSES_SUPPORT_PICTURE_H

#include "tests/passes/support/fixture.h"

/// Pictures that tests draw and compare. All images are of floats.

/// Settings of a filter from assignments, ended by NULL; asserts that they are accepted.
lobe_settings settings_of(const lobe_filter *filter, const char *const *assignments);

/// A filter by name; asserts that there is one.
const lobe_filter *filter_named(const char *name);

/// The parameters of a picture that most tests need.
typedef struct picture_request {
    const char *filter;
    const char *settings[8]; ///< assignments, ended by NULL
    uint32_t width, height;
    uint32_t samples;
    bool outputs; ///< also arbitrary output variables
} picture_request;

/// Draws the renderer's scene; asserts success. Free the frame with lobe_frame_free.
lobe_frame draw(fixture *f, const picture_request *request);
/// Nothing has been logged as an error, not by the validation layer either. The scene's name is for
/// the message.
void assert_silence(const fixture *f, const char *scene, const picture_request *request);
/// Draws, and asserts silence.
lobe_frame draw_silently(fixture *f, const char *scene, const picture_request *request);
/// The same for another scene, which is removed from the renderer afterwards, unless it is held.
lobe_frame draw_scene(fixture *f, const lobe_scene *scene, const picture_request *request);
/// Keeps an unchanging scene in the renderer, so that several pictures share its maps and its
/// filtered environment, until another one or none (NULL) is held.
void hold_scene(fixture *f, const lobe_scene *scene);

/// The channels of a pixel.
const float *pixel_at(const lobe_image *image, uint32_t x, uint32_t y);

bool all_finite(const lobe_image *image);

/// Over red, green and blue: |a - b| / |b|.
double relative_l2(const lobe_image *a, const lobe_image *b);
/// Largest |a - b| of any channel.
double largest_difference(const lobe_image *a, const lobe_image *b);
/// Largest |b| of red, green and blue.
double largest_value(const lobe_image *b);

/// FNV-1a over all bytes.
uint64_t image_hash(const lobe_image *image);

#endif
