#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/colour.h>
#include <lobe/png.h>

#include "tools/compare/image_input.h"
#include "tools/report/html.h"
#include "tools/report/plot_axis.h"
#include "tools/report/plot_style.h"
#include "tools/report/report.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_picture.h"
#include "tools/report/report_rows.h"

/// A scene's renderings: those of the filters that have one, and the reference.
typedef struct gallery {
    lobe_image reference;
    size_t count;
    const sweep_row *rows[REPORT_MAXIMUM_FILTERS];
    size_t filters[REPORT_MAXIMUM_FILTERS]; ///< indices into the report's
    lobe_image pictures[REPORT_MAXIMUM_FILTERS], errors[REPORT_MAXIMUM_FILTERS];
    double scale;         ///< of all error maps
    uint32_t factor;      ///< by which pictures are reduced
    report_window detail; ///< shown texel for texel where pictures are reduced
} gallery;

// ---------------------------------------------------------------------------------------------
// Reading

/// Names in the results are relative to their file.
static char *path_beside(const char *results, const char *name) {
    const char *slash = strrchr(results, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - results) + 1 : 0;
    char *path = malloc(folder + strlen(name) + 1);
    if (path) {
        memcpy(path, results, folder);
        strcpy(path + folder, name);
    }
    return path;
}

static lobe_result read_picture(const report *report, const char *name, lobe_image *picture) {
    char *path = path_beside(report->path, name);
    if (!path)
        return lobe_host_fail(report->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", name);
    image_input input;
    lobe_result result = image_input_read(path, report->host, &input);
    *picture = result == LOBE_OK ? input.image : (lobe_image){0};
    free(path);
    return result;
}

static lobe_result read_row(const report *report, const sweep_row *row, size_t filter,
                            gallery *gallery) {
    size_t index = gallery->count;
    lobe_image *picture = &gallery->pictures[index];
    lobe_result result = read_picture(report, row->picture, picture);
    if (result != LOBE_OK)
        return result;
    gallery->rows[index] = row;
    gallery->filters[index] = filter;
    ++gallery->count;
    const lobe_image *reference = &gallery->reference;
    if (picture->width != reference->width || picture->height != reference->height)
        return lobe_host_fail(report->host, LOBE_ERROR_INVALID_ARGUMENT,
                              "%s: %ux%u pixels, but the reference of scene '%s' has %ux%u",
                              row->picture, picture->width, picture->height, row->scene,
                              reference->width, reference->height);
    return report_error_map(picture, reference, report->host, &gallery->errors[index]);
}

static lobe_result read_gallery(const report *report, const sweep_scene *scene, gallery *gallery) {
    lobe_result result = read_picture(report, scene->reference, &gallery->reference);
    for (size_t i = 0; result == LOBE_OK && i < report->filter_count; ++i) {
        const sweep_row *row =
            sweep_results_default(report->results, scene->name, report->filters[i]);
        // The filter of that name differs from the reference only in how many samples it takes.
        if (row && row->picture && !report_is_far(row->filter))
            result = read_row(report, row, i, gallery);
    }
    return result;
}

static void free_gallery(gallery *gallery) {
    for (size_t i = 0; i < gallery->count; ++i) {
        lobe_image_free(&gallery->pictures[i]);
        lobe_image_free(&gallery->errors[i]);
    }
    lobe_image_free(&gallery->reference);
    free(gallery);
}

/// The worst tenth of all pixels is beyond the scale; else that of the worst filter would leave the
/// maps of the good ones black.
static void choose_views(const report *report, gallery *gallery) {
    const lobe_image *reference = &gallery->reference;
    double most = report_quantile(gallery->errors, gallery->count, 0.9);
    gallery->scale = most > 0 ? plot_nice_number(most) : 1;
    gallery->factor = (reference->width + report->picture_width - 1) / report->picture_width;
    if (gallery->factor > 1 && gallery->count > 0)
        gallery->detail = report_worst_window(gallery->errors, gallery->count,
                                              (reference->width / gallery->factor + 1) / 2,
                                              (reference->height / gallery->factor + 1) / 2);
}

// ---------------------------------------------------------------------------------------------
// Writing

/// `what` and `name` are its text for those who do not see it. Frees the picture.
static lobe_result write_picture(const report *report, lobe_image *picture, const char *class,
                                 const char *what, const char *name) {
    uint8_t *data;
    size_t size;
    lobe_result result = lobe_png_encode(name, picture, report->host, &data, &size);
    if (result == LOBE_OK) {
        fprintf(report->page, "<img class=\"%s\" width=\"%u\" height=\"%u\" alt=\"%s", class,
                picture->width, picture->height, what);
        html_text(report->page, name);
        fputs("\" src=\"data:image/png;base64,", report->page);
        html_base64(report->page, data, size);
        fputs("\">\n", report->page);
    }
    lobe_release(data);
    lobe_image_free(picture);
    return result;
}

static lobe_result write_views(const report *report, const gallery *gallery,
                               const lobe_image *linear, const char *name) {
    lobe_image picture;
    lobe_result result = report_show(linear, gallery->factor, report->host, &picture);
    if (result == LOBE_OK)
        result = write_picture(report, &picture, "whole", "", name);
    if (result != LOBE_OK || gallery->detail.width == 0)
        return result;
    result = report_show_window(linear, &gallery->detail, report->host, &picture);
    return result == LOBE_OK ? write_picture(report, &picture, "detail", "detail of ", name)
                             : result;
}

static void write_numbers(const report *report, const sweep_row *row) {
    fputs("<br>relative L2 ", report->page);
    report_number(report->page, row->error.relative_l2, 4);
    fputs(", FLIP ", report->page);
    report_number(report->page, row->error.flip, 4);
    fputs(",<br>", report->page);
    report_number(report->page, row->rebuilt_ms, 4);
    fputs(" ms rebuilt, ", report->page);
    report_number(report->page, row->retained_ms, 4);
    fputs(" ms retained", report->page);
}

static lobe_result write_filter(const report *report, const gallery *gallery, size_t index) {
    const sweep_row *row = gallery->rows[index];
    fputs("<figure><figcaption>", report->page);
    plot_draw_key(report->page, gallery->filters[index]);
    fputs("<b>", report->page);
    html_text(report->page, row->filter);
    fputs("</b>", report->page);
    write_numbers(report, row);
    fputs("</figcaption>\n", report->page);
    lobe_result result = write_views(report, gallery, &gallery->pictures[index], row->filter);
    lobe_image heat;
    if (result == LOBE_OK)
        result = report_show_errors(&gallery->errors[index], gallery->scale, gallery->factor,
                                    report->host, &heat);
    if (result == LOBE_OK)
        result = write_picture(report, &heat, "errors", "error map of ", row->filter);
    fputs("</figure>\n", report->page);
    return result;
}

/// The heat maps' colours from 0 to the scale.
static void write_scale(const report *report, double scale) {
    enum { STEPS = 50, WIDTH = 300, HEIGHT = 14 };
    fprintf(report->page,
            "<svg class=\"scale\" viewBox=\"-8 0 %d 34\" role=\"img\" aria-label=\"Colours of the "
            "error maps, from 0 to %g\">",
            WIDTH + 16, scale);
    for (int i = 0; i < STEPS; ++i) {
        uint8_t rgb[3];
        lobe_heat_colour(((float)i + 0.5f) / STEPS, rgb);
        fprintf(report->page, "<rect x=\"%d\" width=\"%d\" height=\"%d\" fill=\"#%02x%02x%02x\"/>",
                i * WIDTH / STEPS, WIDTH / STEPS, HEIGHT, rgb[0], rgb[1], rgb[2]);
    }
    plot_axis axis = plot_axis_linear(scale);
    for (size_t i = 0; i < axis.tick_count; ++i) {
        double x = plot_axis_position(&axis, axis.ticks[i]) * WIDTH;
        fprintf(report->page, "<text text-anchor=\"middle\" x=\"%.2f\" y=\"28\">%s</text>", x,
                plot_axis_label(axis.ticks[i]).text);
    }
    fputs("</svg>\n", report->page);
}

static lobe_result write_reference(const report *report, const gallery *gallery) {
    fprintf(report->page, "<figure><figcaption><b>reference</b><br>%u samples a pixel",
            report->results->reference_samples);
    fputs("</figcaption>\n", report->page);
    lobe_result result = write_views(report, gallery, &gallery->reference, "the reference");
    fputs("<div class=\"errors\"><p>Below each picture: how far each pixel is from the reference, "
          "over the reference’s root mean square. The root mean square of a map is the relative L2 "
          "error.</p>\n",
          report->page);
    write_scale(report, gallery->scale);
    fputs("</div></figure>\n", report->page);
    return result;
}

static void write_reduction(const report *report, const gallery *gallery) {
    if (gallery->factor == 1)
        return;
    fprintf(
        report->page,
        "<p>Pictures are reduced by %u in width and height; below each, texel for texel, the %ux%u "
        "pixels at (%u, %u), where the filters err most.</p>\n",
        gallery->factor, gallery->detail.width, gallery->detail.height, gallery->detail.x,
        gallery->detail.y);
}

static lobe_result write_gallery(const report *report, const gallery *gallery) {
    fputs("<h3>Pictures and errors</h3>\n", report->page);
    write_reduction(report, gallery);
    fputs("<div class=\"gallery\">\n", report->page);
    lobe_result result = write_reference(report, gallery);
    for (size_t i = 0; result == LOBE_OK && i < gallery->count; ++i)
        result = write_filter(report, gallery, i);
    fputs("</div>\n", report->page);
    return result;
}

lobe_result report_write_pictures(const report *report, size_t scene) {
    const sweep_scene *described = &report->results->scenes[scene];
    if (!described->reference) {
        fputs("<p>No pictures were kept.</p>\n", report->page);
        return LOBE_OK;
    }
    gallery *gallery = calloc(1, sizeof *gallery);
    if (!gallery)
        return lobe_host_fail(report->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                              report->path);
    lobe_result result = read_gallery(report, described, gallery);
    if (result == LOBE_OK) {
        choose_views(report, gallery);
        result = write_gallery(report, gallery);
    }
    free_gallery(gallery);
    return result;
}
