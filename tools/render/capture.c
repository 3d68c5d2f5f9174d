#include "tools/render/capture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/colour.h>
#include <lobe/lobe.h>

// ---------------------------------------------------------------------------------------------
// Attributes

typedef struct attribute_list {
    lobe_exr_attribute *attributes;
    char (*names)[96];
    size_t count;
} attribute_list;

static bool attributes_allocate(attribute_list *list, size_t capacity) {
    list->attributes = calloc(capacity, sizeof *list->attributes);
    list->names = calloc(capacity, sizeof *list->names);
    list->count = 0;
    return list->attributes && list->names;
}

static void attributes_free(attribute_list *list) {
    free(list->attributes);
    free(list->names);
}

static lobe_exr_attribute *append(attribute_list *list, const char *prefix, const char *name,
                                  lobe_exr_attribute_type type) {
    char *text = list->names[list->count];
    snprintf(text, sizeof *list->names, "%s%s", prefix, name);
    lobe_exr_attribute *attribute = &list->attributes[list->count++];
    *attribute = (lobe_exr_attribute){.name = text, .type = type};
    return attribute;
}

static void append_text(attribute_list *list, const char *name, const char *text) {
    append(list, "", name, LOBE_EXR_TEXT)->text = text;
}

static void append_knob(attribute_list *list, const lobe_knob *knob, double value) {
    if (knob->kind == LOBE_KNOB_CHOICE)
        append(list, "knob.", knob->name, LOBE_EXR_TEXT)->text = knob->choices[(size_t)value];
    else if (knob->kind == LOBE_KNOB_INTEGER)
        append(list, "knob.", knob->name, LOBE_EXR_INTEGER)->integer = (int32_t)value;
    else
        append(list, "knob.", knob->name, LOBE_EXR_NUMBER)->number = (float)value;
}

static void append_times(attribute_list *list, const lobe_profile_summary *times) {
    append(list, "milliseconds", "", LOBE_EXR_NUMBER)->number =
        (float)times->frame.median_milliseconds;
    for (size_t i = 0; i < times->pass_count; i++)
        append(list, "milliseconds.", times->passes[i].name, LOBE_EXR_NUMBER)->number =
            (float)times->passes[i].median_milliseconds;
}

enum { FIXED_ATTRIBUTES = 10 };

static bool describe(const capture *capture, attribute_list *list) {
    size_t knobs = lobe_filter_knob_count(capture->filter);
    if (!attributes_allocate(list, FIXED_ATTRIBUTES + knobs + capture->times->pass_count))
        return false;
    append_text(list, "lobeVersion", lobe_version());
    append_text(list, "scene", capture->scene);
    if (capture->environment)
        append_text(list, "environment", capture->environment);
    append_text(list, "filter", lobe_filter_name(capture->filter));
    append_text(list, "device", capture->device->name);
    append_text(list, "driver", capture->device->driver);
    append(list, "samples", "", LOBE_EXR_INTEGER)->integer = (int32_t)capture->samples;
    if (capture->animated)
        append(list, "seconds", "", LOBE_EXR_NUMBER)->number = (float)capture->seconds;
    for (size_t i = 0; i < knobs; i++)
        append_knob(list, lobe_filter_knob(capture->filter, i), capture->settings->values[i]);
    append_text(list, "timing",
                capture->first_frame ? "a first frame, compilation of its shaders included"
                                     : "medians of later frames");
    append_times(list, capture->times);
    return true;
}

// ---------------------------------------------------------------------------------------------
// OpenEXR

enum { MAXIMUM_LAYERS = 6 };

static size_t describe_layers(const capture *capture, lobe_exr_layer layers[MAXIMUM_LAYERS]) {
    const lobe_frame *frame = capture->frame;
    size_t count = 0;
    layers[count++] = (lobe_exr_layer){.image = &frame->radiance, .depth = capture->depth};
    if (frame->normal_depth.texels) {
        layers[count++] = (lobe_exr_layer){.name = "normal",
                                           .channels = {"X", "Y", "Z", NULL},
                                           .image = &frame->normal_depth,
                                           .depth = LOBE_EXR_FLOAT};
        layers[count++] = (lobe_exr_layer){.name = "depth",
                                           .channels = {NULL, NULL, NULL, "Z"},
                                           .image = &frame->normal_depth,
                                           .depth = LOBE_EXR_FLOAT};
    }
    if (frame->lobes_level.texels) {
        layers[count++] = (lobe_exr_layer){.name = "lobes",
                                           .channels = {"count", NULL},
                                           .image = &frame->lobes_level,
                                           .depth = LOBE_EXR_FLOAT};
        layers[count++] = (lobe_exr_layer){.name = "level",
                                           .channels = {NULL, "MIP"},
                                           .image = &frame->lobes_level,
                                           .depth = LOBE_EXR_FLOAT};
    }
    if (frame->motion.texels)
        layers[count++] = (lobe_exr_layer){.name = "motion",
                                           .channels = {"X", "Y"},
                                           .image = &frame->motion,
                                           .depth = LOBE_EXR_FLOAT};
    return count;
}

lobe_result capture_write_exr(const char *path, const capture *capture, const lobe_host *host) {
    lobe_exr_layer layers[MAXIMUM_LAYERS];
    size_t layer_count = describe_layers(capture, layers);
    attribute_list list = {0};
    lobe_result result = LOBE_ERROR_OUT_OF_MEMORY;
    if (describe(capture, &list))
        result = lobe_exr_write(path,
                                &(lobe_exr_parameters){.layers = layers,
                                                       .layer_count = layer_count,
                                                       .attributes = list.attributes,
                                                       .attribute_count = list.count},
                                host);
    else
        lobe_host_log(host, LOBE_LOG_ERROR, "%s: out of memory", path);
    attributes_free(&list);
    return result;
}

// ---------------------------------------------------------------------------------------------
// PNG

/// Values are counts of lobes, rarely above 8, or MIP levels, of which a map of 4096 texels
/// has 12 above the base: fixed scales, so that pictures can be compared.
static lobe_result heat_map(const capture *capture, float maximum, const lobe_host *host,
                            lobe_image *picture) {
    const lobe_image *values = &capture->frame->radiance;
    lobe_result result =
        lobe_image_allocate(picture, LOBE_FORMAT_RGBA8_SRGB, values->width, values->height, host);
    if (result != LOBE_OK)
        return result;
    const float *value = values->texels;
    uint8_t *texel = picture->texels;
    for (size_t i = 0; i < (size_t)values->width * values->height; i++) {
        float part = value[4 * i + 3] > 0 ? value[4 * i] / maximum : NAN;
        lobe_heat_colour(part, &texel[4 * i]);
        texel[4 * i + 3] = 255;
    }
    return LOBE_OK;
}

lobe_result capture_write_png(const char *path, const capture *capture, const lobe_host *host) {
    double view;
    lobe_image picture;
    lobe_result result = lobe_settings_get(capture->filter, capture->settings, "view", &view, host);
    if (result != LOBE_OK)
        return result;
    if (view == 0)
        result = lobe_display_encode(
            &capture->frame->radiance,
            &(lobe_display_parameters){.exposure = (float)capture->exposure}, host, &picture);
    else
        result = heat_map(capture, view == 1 ? 8.0f : 12.0f, host, &picture);
    if (result == LOBE_OK)
        result = lobe_png_write(path, &picture, host);
    lobe_image_free(&picture);
    return result;
}
