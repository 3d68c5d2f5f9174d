#include "tools/compare/compare.h"

#include <stdio.h>
#include <string.h>

#include <lobe/colour.h>
#include <lobe/png.h>

#include "tools/compare/side_by_side.h"

lobe_result compare_write_difference(const compare_job *job) {
    const lobe_image *errors = &job->images[0].flip_errors;
    lobe_image picture;
    lobe_result result = lobe_image_allocate(&picture, LOBE_FORMAT_RGBA8_SRGB, errors->width,
                                             errors->height, &job->host);
    if (result != LOBE_OK)
        return result;
    uint8_t *texels = picture.texels;
    for (size_t index = 0; index < (size_t)errors->width * errors->height; index++) {
        lobe_heat_colour((float)job->magnification * ((const float *)errors->texels)[index],
                         texels + 4 * index);
        texels[4 * index + 3] = 255;
    }
    result = lobe_png_write(job->difference_path, &picture, &job->host);
    lobe_image_free(&picture);
    return result;
}

lobe_result compare_check_crop(const compare_job *job) {
    const lobe_image *image = &job->images[0].input.image;
    const uint32_t *crop = job->crop;
    if (job->side_by_side_path == NULL || crop[2] == 0 ||
        ((uint64_t)crop[0] + crop[2] <= image->width &&
         (uint64_t)crop[1] + crop[3] <= image->height))
        return LOBE_OK;
    lobe_host_log(&job->host, LOBE_LOG_ERROR, "crop %s lies outside the images' %ux%u",
                  job->crop_text, image->width, image->height);
    return LOBE_ERROR_INVALID_ARGUMENT;
}

static lobe_result crop_image(const compare_job *job, const lobe_image *source,
                              lobe_image *target) {
    const uint32_t whole[4] = {0, 0, source->width, source->height};
    const uint32_t *crop = job->crop[2] > 0 ? job->crop : whole;
    lobe_result result = lobe_image_allocate(target, source->format, crop[2], crop[3], &job->host);
    if (result != LOBE_OK)
        return result;
    size_t size = lobe_format_size(source->format);
    for (size_t y = 0; y < crop[3]; y++)
        memcpy((uint8_t *)target->texels + y * crop[2] * size,
               (const uint8_t *)source->texels + ((crop[1] + y) * source->width + crop[0]) * size,
               crop[2] * size);
    return LOBE_OK;
}

/// Text and images of a panel that the panel itself only refers to.
typedef struct panel_content {
    char caption[256], error_caption[64];
    lobe_image picture, errors;
} panel_content;

/// PNG files are shown as they are.
static lobe_result make_picture(const compare_job *job, const compared *image,
                                lobe_image *picture) {
    lobe_display_parameters display = {
        .exposure = (float)job->exposure,
        .tone_map = image->input.high_dynamic_range ? LOBE_TONE_MAP_SHOULDER : LOBE_TONE_MAP_NONE,
    };
    lobe_image linear;
    lobe_result result = crop_image(job, &image->input.image, &linear);
    if (result == LOBE_OK)
        result = lobe_display_encode(&linear, &display, &job->host, picture);
    lobe_image_free(&linear);
    return result;
}

static lobe_result fill_panel(const compare_job *job, const compared *image, panel_content *content,
                              side_by_side_panel *panel) {
    const char *slash = strrchr(image->path, '/');
    const char *name = slash != NULL ? slash + 1 : image->path;
    const char *dot = strrchr(name, '.');
    int length = dot != NULL && dot != name ? (int)(dot - name) : (int)strlen(name);
    snprintf(content->caption, sizeof content->caption, "%.*s", length, name);
    *panel = (side_by_side_panel){.caption = content->caption, .picture = &content->picture};
    lobe_result result = make_picture(job, image, &content->picture);
    if (result == LOBE_OK && image->flip_errors.texels != NULL) {
        snprintf(content->error_caption, sizeof content->error_caption, "flip %.3f, rel. L2 %.3f",
                 image->metrics.flip, image->metrics.relative_l2);
        panel->error_caption = content->error_caption;
        panel->errors = &content->errors;
        result = crop_image(job, &image->flip_errors, &content->errors);
    }
    return result;
}

lobe_result compare_write_side_by_side(const compare_job *job) {
    panel_content contents[COMPARE_MAXIMUM_TESTS + 1] = {0};
    side_by_side_panel panels[COMPARE_MAXIMUM_TESTS + 1] = {0};
    side_by_side_parameters parameters = {
        .zoom = job->zoom,
        .error_magnification = (float)job->magnification,
    };
    lobe_image picture = {0};
    lobe_result result = LOBE_OK;
    for (size_t index = 0; index <= job->test_count && result == LOBE_OK; index++)
        result = fill_panel(job, &job->images[index], &contents[index], &panels[index]);
    if (result == LOBE_OK)
        result =
            side_by_side_compose(panels, job->test_count + 1, &parameters, &job->host, &picture);
    if (result == LOBE_OK)
        result = lobe_png_write(job->side_by_side_path, &picture, &job->host);
    lobe_image_free(&picture);
    for (size_t index = 0; index <= job->test_count; index++) {
        lobe_image_free(&contents[index].picture);
        lobe_image_free(&contents[index].errors);
    }
    return result;
}
