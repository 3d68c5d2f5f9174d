#include "tools/report/report_picture.h"

#include <math.h>
#include <string.h>

#include <lobe/colour.h>

// ---------------------------------------------------------------------------------------------
// Errors

static double squared_length(const float *rgb) {
    return (double)rgb[0] * rgb[0] + (double)rgb[1] * rgb[1] + (double)rgb[2] * rgb[2];
}

static size_t texel_count(const lobe_image *image) {
    return (size_t)image->width * image->height;
}

lobe_result report_error_map(const lobe_image *test, const lobe_image *reference,
                             const lobe_host *host, lobe_image *errors) {
    lobe_result result = lobe_image_allocate(errors, LOBE_FORMAT_R32_FLOAT, reference->width,
                                             reference->height, host);
    if (result != LOBE_OK)
        return result;
    const float *a = test->texels, *b = reference->texels;
    size_t count = texel_count(reference);
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
        sum += squared_length(&b[4 * i]);
    double scale = 1 / sqrt(sum / (double)count);
    for (size_t i = 0; i < count; ++i) {
        const float *p = &a[4 * i], *q = &b[4 * i];
        const float difference[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
        ((float *)errors->texels)[i] = (float)(sqrt(squared_length(difference)) * scale);
    }
    return LOBE_OK;
}

/// Counts of values by their logarithm: 16 steps each doubling, from 2^-32 to 2^32.
enum { STEPS = 16, HALF = 32 * STEPS };

static size_t step_of(float value) {
    double step = floor(log2(value) * STEPS) + HALF;
    return (size_t)fmin(fmax(step, 0), 2 * HALF - 1);
}

double report_quantile(const lobe_image *images, size_t count, double part) {
    size_t counts[2 * HALF] = {0}, total = 0, sum = 0;
    for (size_t i = 0; i < count; ++i) {
        const float *texels = images[i].texels;
        for (size_t k = 0; texels && k < texel_count(&images[i]); ++k) {
            if (isfinite(texels[k])) {
                ++counts[step_of(texels[k])];
                ++total;
            }
        }
    }
    for (size_t step = 0; step < 2 * HALF && total > 0; ++step) {
        sum += counts[step];
        if ((double)sum >= part * (double)total)
            return step == 0 ? 0 : exp2(((double)step + 1 - HALF) / STEPS);
    }
    return 0;
}

static double window_sum(const lobe_image *errors, const report_window *window) {
    const float *texels = errors->texels;
    double sum = 0;
    for (uint32_t y = window->y; y < window->y + window->height; ++y) {
        for (uint32_t x = window->x; x < window->x + window->width; ++x)
            sum += texels[(size_t)y * errors->width + x];
    }
    return isfinite(sum) ? sum : 0;
}

report_window report_worst_window(const lobe_image *errors, size_t count, uint32_t width,
                                  uint32_t height) {
    report_window worst = {0, 0, width, height};
    double most = 0;
    for (uint32_t y = 0; y + height <= errors[0].height; y += (height + 1) / 2) {
        for (uint32_t x = 0; x + width <= errors[0].width; x += (width + 1) / 2) {
            const report_window window = {x, y, width, height};
            double sum = 0;
            for (size_t i = 0; i < count; ++i)
                sum += window_sum(&errors[i], &window);
            if (sum > most) {
                most = sum;
                worst = window;
            }
        }
    }
    return worst;
}

// ---------------------------------------------------------------------------------------------
// Blocks

/// The texels of a block, fewer at the right and lower edge.
static report_window block_at(const lobe_image *image, uint32_t x, uint32_t y, uint32_t factor) {
    report_window block = {x * factor, y * factor, factor, factor};
    if (block.x + block.width > image->width)
        block.width = image->width - block.x;
    if (block.y + block.height > image->height)
        block.height = image->height - block.y;
    return block;
}

static void average_colour(const lobe_image *picture, const report_window *block,
                           const float decoded[256], uint8_t average[4]) {
    const uint8_t *texels = picture->texels;
    float sum[3] = {0}, count = (float)block->width * (float)block->height;
    for (uint32_t y = block->y; y < block->y + block->height; ++y) {
        for (uint32_t x = block->x; x < block->x + block->width; ++x) {
            const uint8_t *texel = &texels[4 * ((size_t)y * picture->width + x)];
            for (int channel = 0; channel < 3; ++channel)
                sum[channel] += decoded[texel[channel]];
        }
    }
    for (int channel = 0; channel < 3; ++channel)
        average[channel] = (uint8_t)(255 * lobe_srgb_encode(sum[channel] / count) + 0.5f);
    average[3] = 255;
}

static float average_error(const lobe_image *errors, const report_window *block) {
    return (float)(window_sum(errors, block) / ((double)block->width * block->height));
}

static lobe_result allocate_reduced(const lobe_image *source, uint32_t factor,
                                    const lobe_host *host, lobe_image *picture) {
    return lobe_image_allocate(picture, LOBE_FORMAT_RGBA8_SRGB,
                               (source->width + factor - 1) / factor,
                               (source->height + factor - 1) / factor, host);
}

static lobe_result reduce(const lobe_image *whole, uint32_t factor, const lobe_host *host,
                          lobe_image *picture) {
    lobe_result result = allocate_reduced(whole, factor, host, picture);
    if (result != LOBE_OK)
        return result;
    float decoded[256];
    for (int code = 0; code < 256; ++code)
        decoded[code] = lobe_srgb_decode((float)code / 255);
    uint8_t *texels = picture->texels;
    for (uint32_t y = 0; y < picture->height; ++y) {
        for (uint32_t x = 0; x < picture->width; ++x) {
            const report_window block = block_at(whole, x, y, factor);
            average_colour(whole, &block, decoded, &texels[4 * ((size_t)y * picture->width + x)]);
        }
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------

lobe_result report_show(const lobe_image *linear, uint32_t factor, const lobe_host *host,
                        lobe_image *picture) {
    lobe_image whole;
    lobe_result result = lobe_display_encode(linear, NULL, host, factor > 1 ? &whole : picture);
    if (result != LOBE_OK || factor == 1)
        return result;
    result = reduce(&whole, factor, host, picture);
    lobe_image_free(&whole);
    return result;
}

lobe_result report_show_errors(const lobe_image *errors, double scale, uint32_t factor,
                               const lobe_host *host, lobe_image *picture) {
    lobe_result result = allocate_reduced(errors, factor, host, picture);
    if (result != LOBE_OK)
        return result;
    uint8_t *texels = picture->texels;
    for (uint32_t y = 0; y < picture->height; ++y) {
        for (uint32_t x = 0; x < picture->width; ++x) {
            const report_window block = block_at(errors, x, y, factor);
            uint8_t *texel = &texels[4 * ((size_t)y * picture->width + x)];
            lobe_heat_colour(average_error(errors, &block) / (float)scale, texel);
            texel[3] = 255;
        }
    }
    return LOBE_OK;
}

lobe_result report_show_window(const lobe_image *linear, const report_window *window,
                               const lobe_host *host, lobe_image *picture) {
    lobe_image part;
    lobe_result result =
        lobe_image_allocate(&part, linear->format, window->width, window->height, host);
    if (result != LOBE_OK)
        return result;
    size_t size = lobe_format_size(linear->format);
    for (size_t y = 0; y < window->height; ++y)
        memcpy((uint8_t *)part.texels + y * window->width * size,
               (const uint8_t *)linear->texels +
                   ((window->y + y) * linear->width + window->x) * size,
               window->width * size);
    result = lobe_display_encode(&part, NULL, host, picture);
    lobe_image_free(&part);
    return result;
}
