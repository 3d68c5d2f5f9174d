#include "tests/passes/support/picture.h"

#include <math.h>

const lobe_filter *filter_named(const char *name) {
    const lobe_filter *filter;
    assert_int_equal(lobe_filter_find(name, NULL, &filter), LOBE_OK);
    return filter;
}

lobe_settings settings_of(const lobe_filter *filter, const char *const *assignments) {
    lobe_settings settings;
    lobe_settings_default(filter, &settings);
    for (; *assignments; assignments++) {
        if (lobe_settings_set(filter, &settings, *assignments, NULL) != LOBE_OK)
            fail_msg("filter %s does not take %s", lobe_filter_name(filter), *assignments);
    }
    return settings;
}

lobe_frame draw(fixture *f, const picture_request *request) {
    const lobe_filter *filter = filter_named(request->filter);
    lobe_settings settings = settings_of(filter, request->settings);
    lobe_frame frame;
    lobe_result result = lobe_renderer_render(f->renderer,
                                              &(lobe_render_parameters){
                                                  .filter = filter,
                                                  .settings = &settings,
                                                  .width = request->width,
                                                  .height = request->height,
                                                  .reference.samples = request->samples,
                                                  .fits.cache = f->fits_cache,
                                                  .aov = request->outputs,
                                              },
                                              &frame);
    if (result != LOBE_OK)
        fail_msg("%s: %s: %s", request->filter, lobe_result_name(result), f->error);
    return frame;
}

void assert_silence(const fixture *f, const char *scene, const picture_request *request) {
    if (f->errors != 0 || lobe_device_validation_count(f->device) != 0)
        fail_msg("%s, %s, %s: %s", scene, request->filter,
                 request->settings[0] ? request->settings[0] : "-", f->error);
}

lobe_frame draw_silently(fixture *f, const char *scene, const picture_request *request) {
    lobe_frame frame = draw(f, request);
    assert_silence(f, scene, request);
    return frame;
}

void hold_scene(fixture *f, const lobe_scene *scene) {
    if (lobe_renderer_set_scene(f->renderer, scene) != LOBE_OK)
        fail_msg("%s: %s", scene ? scene->name : "no scene", f->error);
    f->held = scene;
}

lobe_frame draw_scene(fixture *f, const lobe_scene *scene, const picture_request *request) {
    if (f->held == scene)
        return draw(f, request);
    hold_scene(f, scene);
    lobe_frame frame = draw(f, request);
    hold_scene(f, NULL);
    return frame;
}

static size_t value_count(const lobe_image *image) {
    return (size_t)image->width * image->height * lobe_format_channels(image->format);
}

const float *pixel_at(const lobe_image *image, uint32_t x, uint32_t y) {
    assert_true(x < image->width && y < image->height);
    return (const float *)image->texels +
           ((size_t)y * image->width + x) * lobe_format_channels(image->format);
}

bool all_finite(const lobe_image *image) {
    const float *values = image->texels;
    for (size_t i = 0; i < value_count(image); i++) {
        if (!isfinite(values[i]))
            return false;
    }
    return true;
}

static void assert_alike(const lobe_image *a, const lobe_image *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->format, b->format);
}

double relative_l2(const lobe_image *a, const lobe_image *b) {
    assert_alike(a, b);
    const float *x = a->texels, *y = b->texels;
    double difference = 0, size = 0;
    for (size_t i = 0; i < value_count(a); i++) {
        if (i % 4 == 3)
            continue;
        difference += ((double)x[i] - (double)y[i]) * ((double)x[i] - (double)y[i]);
        size += (double)y[i] * (double)y[i];
    }
    return sqrt(difference / size);
}

double largest_difference(const lobe_image *a, const lobe_image *b) {
    assert_alike(a, b);
    const float *x = a->texels, *y = b->texels;
    double largest = 0;
    for (size_t i = 0; i < value_count(a); i++) {
        double difference = fabs((double)x[i] - (double)y[i]);
        // A NaN is the largest of all.
        if (!(difference <= largest))
            largest = difference;
    }
    return largest;
}

double largest_value(const lobe_image *b) {
    const float *values = b->texels;
    double largest = 0;
    for (size_t i = 0; i < value_count(b); i++) {
        if (i % 4 != 3)
            largest = fmax(largest, fabs((double)values[i]));
    }
    return largest;
}

uint64_t image_hash(const lobe_image *image) {
    const uint8_t *bytes = image->texels;
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < value_count(image) * sizeof(float); i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}
