#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include <lobe/exr.h>

#include "tools/cli/console.h"
#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"
#include "tools/compare/compare.h"
#include "tools/compare/flip.h"

static const compared *reference_of(const compare_job *job) {
    return &job->images[job->test_count];
}

// ---------------------------------------------------------------------------------------------
// Measuring

static lobe_result read_images(compare_job *job) {
    for (size_t index = 0; index <= job->test_count; index++) {
        compared *image = &job->images[index];
        lobe_result result = image_input_read(image->path, &job->host, &image->input);
        if (result != LOBE_OK)
            return result;
        if (image->input.high_dynamic_range != job->images[0].input.high_dynamic_range) {
            lobe_host_log(&job->host, LOBE_LOG_ERROR,
                          "%s and %s: an OpenEXR image cannot be compared with a PNG",
                          job->images[0].path, image->path);
            return LOBE_ERROR_INVALID_ARGUMENT;
        }
    }
    return LOBE_OK;
}

static const char *const part_names[COMPARE_PART_COUNT + 1] = {"all", "inside", "silhouettes",
                                                               NULL};

static lobe_result read_depth(compare_job *job, lobe_image *depth) {
    const compared *reference = reference_of(job);
    const lobe_image *radiance = &reference->input.image;
    lobe_result result = LOBE_ERROR_NOT_FOUND;
    if (reference->input.high_dynamic_range)
        result = lobe_exr_read(reference->path, "depth", &(lobe_host){0}, depth);
    if (result == LOBE_OK && depth->width == radiance->width && depth->height == radiance->height)
        return LOBE_OK;
    if (result == LOBE_OK) {
        lobe_host_log(&job->host, LOBE_LOG_ERROR, "%s: --part: the layer depth is %ux%u, not %ux%u",
                      reference->path, depth->width, depth->height, radiance->width,
                      radiance->height);
        lobe_image_free(depth);
        return LOBE_ERROR_INVALID_ARGUMENT;
    }
    lobe_host_log(&job->host, LOBE_LOG_ERROR, "%s: --part needs the reference's depth: %s",
                  reference->path,
                  result == LOBE_ERROR_NOT_FOUND
                      ? "it has no layer of that name; render it with --aov to an .exr"
                      : lobe_result_message(result));
    return result;
}

static lobe_result find_part(compare_job *job) {
    if (job->part == COMPARE_PART_ALL)
        return LOBE_OK;
    lobe_image depth;
    lobe_result result = read_depth(job, &depth);
    if (result != LOBE_OK)
        return result;
    result = silhouettes_find_part(&depth, job->part, &job->host, &job->part_pixels);
    size_t count = (size_t)depth.width * depth.height;
    for (size_t index = 0; result == LOBE_OK && index < count; index++)
        job->part_count += job->part_pixels[index];
    lobe_image_free(&depth);
    if (result == LOBE_OK && job->part_count == 0) {
        lobe_host_log(&job->host, LOBE_LOG_ERROR, "%s: --part %s has no pixel",
                      reference_of(job)->path, part_names[job->part]);
        result = LOBE_ERROR_INVALID_ARGUMENT;
    }
    return result;
}

static lobe_result measure(compare_job *job) {
    const compared *reference = reference_of(job);
    for (size_t index = 0; index < job->test_count; index++) {
        compared *test = &job->images[index];
        error_metrics_parameters parameters = {
            .test_name = test->path,
            .reference_name = reference->path,
            .high_dynamic_range = reference->input.high_dynamic_range,
            .pixels_per_degree = job->pixels_per_degree,
            .pixels = job->part_pixels,
        };
        lobe_result result =
            error_metrics_measure(&test->input.image, &reference->input.image, &parameters,
                                  &job->host, &test->metrics, &test->flip_errors);
        if (result != LOBE_OK)
            return result;
    }
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Printing

static void print_list(const error_metrics *metrics) {
    for (int index = 0; index < ERROR_METRICS_COUNT; index++)
        printf("%s %.6g\n", error_metrics_name(index), error_metrics_value(metrics, index));
}

static void print_table(const compare_job *job) {
    int width = (int)strlen("image");
    for (size_t test = 0; test < job->test_count; test++) {
        int length = (int)strlen(job->images[test].path);
        width = length > width ? length : width;
    }
    printf("%-*s", width, "image");
    for (int index = 0; index < ERROR_METRICS_COUNT; index++)
        printf(" %12s", error_metrics_name(index));
    for (size_t test = 0; test < job->test_count; test++) {
        printf("\n%-*s", width, job->images[test].path);
        for (int index = 0; index < ERROR_METRICS_COUNT; index++)
            printf(" %12.6g", error_metrics_value(&job->images[test].metrics, index));
    }
    putchar('\n');
}

/// JSON has no infinity: cJSON writes null for it.
static cJSON *describe_test(const compare_job *job, const compared *test) {
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "test", test->path);
    cJSON_AddStringToObject(object, "reference", reference_of(job)->path);
    int size[2] = {(int)test->input.image.width, (int)test->input.image.height};
    cJSON_AddItemToObject(object, "size", cJSON_CreateIntArray(size, 2));
    cJSON_AddBoolToObject(object, "high_dynamic_range", test->input.high_dynamic_range);
    if (job->part != COMPARE_PART_ALL) {
        cJSON_AddStringToObject(object, "part", part_names[job->part]);
        cJSON_AddNumberToObject(object, "pixels", (double)job->part_count);
    }
    for (int index = 0; index < ERROR_METRICS_COUNT; index++)
        cJSON_AddNumberToObject(object, error_metrics_name(index),
                                error_metrics_value(&test->metrics, index));
    return object;
}

static lobe_result print_json(const compare_job *job) {
    cJSON *root = job->test_count == 1 ? describe_test(job, &job->images[0]) : cJSON_CreateArray();
    for (size_t test = 0; job->test_count > 1 && test < job->test_count; test++)
        cJSON_AddItemToArray(root, describe_test(job, &job->images[test]));
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (text == NULL) {
        lobe_host_log(&job->host, LOBE_LOG_ERROR, "out of memory printing JSON");
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    puts(text);
    free(text);
    return LOBE_OK;
}

static lobe_result print_metrics(const compare_job *job) {
    lobe_result result = LOBE_OK;
    if (job->json)
        result = print_json(job);
    else if (job->test_count == 1)
        print_list(&job->images[0].metrics);
    else
        print_table(job);
    if (result == LOBE_OK && (fflush(stdout) != 0 || ferror(stdout))) {
        lobe_host_log(&job->host, LOBE_LOG_ERROR, "standard output cannot be written");
        result = LOBE_ERROR_WRITE;
    }
    return result;
}

// ---------------------------------------------------------------------------------------------
// Command line

static bool parse_crop(const char *text, uint32_t crop[4]) {
    double values[4];
    if (!option_parse_numbers(text, 4, values))
        return false;
    for (int index = 0; index < 4; index++) {
        double least = index < 2 ? 0.0 : 1.0;
        if (values[index] != floor(values[index]) || values[index] < least ||
            values[index] > LOBE_IMAGE_MAXIMUM_EXTENT)
            return false;
        crop[index] = (uint32_t)values[index];
    }
    return true;
}

static int check_usage(const option_table *table, compare_job *job) {
    if (job->difference_path != NULL && job->test_count > 1)
        return options_usage_error(table, "--diff shows one test, but %zu were given",
                                   job->test_count);
    if (job->crop_text != NULL && !parse_crop(job->crop_text, job->crop))
        return options_usage_error(table, "--crop: '%s' is not X,Y,WIDTH,HEIGHT in pixels",
                                   job->crop_text);
    return 0;
}

static int execute(compare_job *job) {
    lobe_result result = read_images(job);
    if (result == LOBE_OK)
        result = compare_check_crop(job);
    if (result == LOBE_OK)
        result = find_part(job);
    if (result == LOBE_OK)
        result = measure(job);
    if (result == LOBE_OK && job->difference_path != NULL)
        result = compare_write_difference(job);
    if (result == LOBE_OK && job->side_by_side_path != NULL)
        result = compare_write_side_by_side(job);
    if (result == LOBE_OK)
        result = print_metrics(job);
    for (size_t index = 0; index <= job->test_count; index++) {
        lobe_image_free(&job->images[index].input.image);
        lobe_image_free(&job->images[index].flip_errors);
    }
    free(job->part_pixels);
    return result == LOBE_OK ? 0 : 1;
}

static int run(int argc, char **argv) {
    compare_job job = {.host = console_host(false)};
    const option options[] = {
        {.name = "part",
         .kind = OPTION_CHOICE,
         .argument = "PART",
         .summary = "measure only along the reference's silhouettes, or only what is inside them, "
                    "without background; the reference must have a depth layer (render --aov)",
         .target = &job.part,
         .fallback = "all",
         .choices = part_names},
        {.name = "diff",
         .kind = OPTION_TEXT,
         .argument = "FILE.png",
         .summary = "write the FLIP error of each pixel as a heat map",
         .target = &job.difference_path},
        {.name = "side-by-side",
         .kind = OPTION_TEXT,
         .argument = "FILE.png",
         .summary = "write all images side by side, with their FLIP errors below",
         .target = &job.side_by_side_path},
        {.name = "crop",
         .kind = OPTION_TEXT,
         .argument = "X,Y,W,H",
         .summary = "with --side-by-side: show only this part",
         .target = &job.crop_text},
        {.name = "zoom",
         .kind = OPTION_INTEGER,
         .argument = "N",
         .summary = "with --side-by-side: enlarge pixels",
         .target = &job.zoom,
         .fallback = "1",
         .minimum = 1,
         .maximum = 32},
        {.name = "exposure",
         .kind = OPTION_NUMBER,
         .argument = "STOPS",
         .summary = "with --side-by-side: brighten the images",
         .target = &job.exposure,
         .fallback = "0",
         .minimum = -40,
         .maximum = 40},
        {.name = "magnify",
         .kind = OPTION_NUMBER,
         .argument = "FACTOR",
         .summary = "multiply the errors shown by heat maps",
         .target = &job.magnification,
         .fallback = "1",
         .minimum = 0.001,
         .maximum = 1000},
        {.name = "pixels-per-degree",
         .kind = OPTION_NUMBER,
         .argument = "N",
         .summary = "viewing condition assumed by FLIP",
         .target = &job.pixels_per_degree,
         .fallback = "67.0206",
         .minimum = FLIP_PIXELS_PER_DEGREE_MINIMUM,
         .maximum = FLIP_PIXELS_PER_DEGREE_MAXIMUM},
        {.name = "json", .kind = OPTION_FLAG, .summary = "print JSON", .target = &job.json},
    };
    const option_table table = {
        .program = "lobe compare",
        .operands = "TEST... REFERENCE",
        .summary = "Measures how far images are from a reference of the same size. OpenEXR files\n"
                   "are compared as linear radiance (FLIP for high dynamic range), PNG files as\n"
                   "they are shown.\n\n"
                   "  rmse          root of the mean squared error\n"
                   "  relative_mse  mean of (a - b)^2 / (b^2 + 0.01)\n"
                   "  relative_l2   |a - b| / |b|, Euclidean lengths\n"
                   "  relative_l1   sum of |a - b| / sum of |b|\n"
                   "  psnr          decibels below the reference's largest value (PNG: below 1)\n"
                   "  mean_ratio    sum of a / sum of b: above 1, a is too bright on the whole\n"
                   "  flip          mean of FLIP (Andersson et al. 2020, 2021) [0, 1]",
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .minimum_operands = 2,
        .maximum_operands = COMPARE_MAXIMUM_TESTS + 1,
        .operand_values = OPTION_VALUES_FILE,
    };
    option_list operands = {0};
    int status;
    if (options_parse(&table, argc, argv, &operands, &status)) {
        job.test_count = operands.count - 1;
        for (size_t index = 0; index < operands.count; index++)
            job.images[index].path = operands.values[index];
        status = check_usage(&table, &job);
        if (status == 0)
            status = execute(&job);
    }
    options_free(&table, &operands);
    return status;
}

const subcommand compare_subcommand = {
    .name = "compare",
    .summary = "measure how far images are from a reference",
    .run = run,
};
