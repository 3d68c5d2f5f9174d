#include "tools/compare/flip.h"

#include <math.h>
#include <stdlib.h>

#include "tools/compare/convolution.h"
#include "tools/compare/flip_colour.h"
#include "tools/compare/flip_exposures.h"

// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, 2020, "FLIP: A Difference
// Evaluator for Alternating Images". The constants are the paper's.
#define COLOUR_EXPONENT  0.7f  // qc
#define FEATURE_EXPONENT 0.5f  // qf
#define COLOUR_SHARE     0.4f  // pc: of the largest distance, where the slope changes
#define ERROR_SHARE      0.95f // pt: the error there
#define FEATURE_WIDTH    0.082 // w: degrees from peak to trough of the edge detector

/// Intermediate results of an image: planes with one float per texel.
typedef struct flip_view {
    float *opponent[3]; ///< filtered as the eye does
    float *edges, *points;
} flip_view;

typedef struct flip_filters {
    convolution_kernel achromatic, red_green, blue_yellow[2];
    float blue_yellow_weights[2]; ///< of the two Gaussians, sum 1
    convolution_kernel gaussian, first, second;
} flip_filters;

typedef struct flip_job {
    size_t width, height;
    flip_filters filters;
    flip_view views[2];
    float *scratch[3]; ///< planes
    float *padded;     ///< a row and its surroundings
    float *rows[4];
    float *memory;          ///< holds all of the above
    float largest_distance; ///< cmax: between the two farthest colours, green and blue, to the qc
} flip_job;

// ---------------------------------------------------------------------------------------------
// Filters

/// Contrast sensitivity as a Gaussian in space: a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees. Its
/// deviation in texels.
static double sensitivity_deviation(double b, double pixels_per_degree) {
    return sqrt(b / (2.0 * M_PI * M_PI)) * pixels_per_degree;
}

/// The weight of a Gaussian in two dimensions is its factor times the square of its sum over the
/// kernel's texels.
static double sensitivity_weight(double a, double b, double deviation, int radius) {
    double sum = 0.0;
    for (int i = -radius; i <= radius; i++)
        sum += exp(-i * i / (2.0 * deviation * deviation));
    return a * sqrt(M_PI / b) * sum * sum;
}

// The colour pipeline: table of the parameters a and b of the contrast sensitivity functions.
static void build_sensitivity(flip_filters *filters, double pixels_per_degree) {
    static const double blue_yellow_a[2] = {34.1, 13.5}, blue_yellow_b[2] = {0.04, 0.025};
    int radius = (int)ceil(3.0 * sensitivity_deviation(blue_yellow_b[0], pixels_per_degree));
    convolution_gaussian(&filters->achromatic, sensitivity_deviation(0.0047, pixels_per_degree),
                         radius);
    convolution_gaussian(&filters->red_green, sensitivity_deviation(0.0053, pixels_per_degree),
                         radius);
    double weights[2];
    for (int term = 0; term < 2; term++) {
        double deviation = sensitivity_deviation(blue_yellow_b[term], pixels_per_degree);
        convolution_gaussian(&filters->blue_yellow[term], deviation, radius);
        weights[term] =
            sensitivity_weight(blue_yellow_a[term], blue_yellow_b[term], deviation, radius);
    }
    for (int term = 0; term < 2; term++)
        filters->blue_yellow_weights[term] = (float)(weights[term] / (weights[0] + weights[1]));
}

// The feature pipeline.
static void build_detectors(flip_filters *filters, double pixels_per_degree) {
    double deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    int radius = (int)ceil(3.0 * deviation);
    convolution_gaussian(&filters->gaussian, deviation, radius);
    convolution_gaussian_derivative(&filters->first, deviation, radius, 1);
    convolution_gaussian_derivative(&filters->second, deviation, radius, 2);
}

// ---------------------------------------------------------------------------------------------
// One image

static void filter_rows(flip_job *job, const float *source, const convolution_kernel *kernel,
                        float *target) {
    for (size_t y = 0; y < job->height; y++)
        convolution_row(source + y * job->width, job->width, kernel, job->padded,
                        target + y * job->width);
}

static void filter_plane(flip_job *job, const convolution_kernel *kernel, float *plane) {
    filter_rows(job, plane, kernel, job->scratch[0]);
    for (size_t y = 0; y < job->height; y++)
        convolution_columns(job->scratch[0], job->width, job->height, y, kernel,
                            plane + y * job->width);
}

static void filter_blue_yellow(flip_job *job, float *plane) {
    const flip_filters *filters = &job->filters;
    for (int term = 0; term < 2; term++)
        filter_rows(job, plane, &filters->blue_yellow[term], job->scratch[term]);
    for (size_t y = 0; y < job->height; y++) {
        float *row = plane + y * job->width;
        for (int term = 0; term < 2; term++)
            convolution_columns(job->scratch[term], job->width, job->height, y,
                                &filters->blue_yellow[term], job->rows[term]);
        for (size_t x = 0; x < job->width; x++)
            row[x] = filters->blue_yellow_weights[0] * job->rows[0][x] +
                     filters->blue_yellow_weights[1] * job->rows[1][x];
    }
}

/// Strength of edges and points: lengths of the gradient and of the vector of second derivatives.
static void detect_features(flip_job *job, flip_view *view) {
    const flip_filters *filters = &job->filters;
    filter_rows(job, view->opponent[0], &filters->gaussian, job->scratch[0]);
    filter_rows(job, view->opponent[0], &filters->first, job->scratch[1]);
    filter_rows(job, view->opponent[0], &filters->second, job->scratch[2]);
    const float *const sources[4] = {job->scratch[1], job->scratch[0], job->scratch[2],
                                     job->scratch[0]};
    const convolution_kernel *const kernels[4] = {&filters->gaussian, &filters->first,
                                                  &filters->gaussian, &filters->second};
    // Y is in [0, 1] for the detectors, (Y + 16) / 116; their weights sum to 0, so the 16 has no
    // effect and the 116 may come last.
    const float scale = 1.0f / 116.0f;
    for (size_t y = 0; y < job->height; y++) {
        for (int filter = 0; filter < 4; filter++)
            convolution_columns(sources[filter], job->width, job->height, y, kernels[filter],
                                job->rows[filter]);
        float *edges = view->edges + y * job->width, *points = view->points + y * job->width;
        for (size_t x = 0; x < job->width; x++) {
            const float dx = job->rows[0][x], dy = job->rows[1][x];
            const float dxx = job->rows[2][x], dyy = job->rows[3][x];
            edges[x] = scale * sqrtf(dx * dx + dy * dy);
            points[x] = scale * sqrtf(dxx * dxx + dyy * dyy);
        }
    }
}

typedef float (*flip_curve)(float value, float gain);

static float clamp(float value, float gain) {
    return fminf(fmaxf(value * gain, 0.0f), 1.0f);
}

static void view_image(flip_job *job, const lobe_image *image, flip_curve curve, float gain,
                       flip_view *view) {
    const float *texels = image->texels;
    for (size_t index = 0; index < job->width * job->height; index++) {
        float rgb[3], opponent[3];
        for (int channel = 0; channel < 3; channel++)
            rgb[channel] = curve(texels[4 * index + channel], gain);
        flip_colour_to_opponent(rgb, opponent);
        for (int channel = 0; channel < 3; channel++)
            view->opponent[channel][index] = opponent[channel];
    }
    detect_features(job, view);
    filter_plane(job, &job->filters.achromatic, view->opponent[0]);
    filter_plane(job, &job->filters.red_green, view->opponent[1]);
    filter_blue_yellow(job, view->opponent[2]);
}

// ---------------------------------------------------------------------------------------------
// Differences

static void perceived_colour(const flip_view *view, size_t index, float lab[3]) {
    float opponent[3], rgb[3];
    for (int channel = 0; channel < 3; channel++)
        opponent[channel] = view->opponent[channel][index];
    flip_colour_from_opponent(opponent, rgb);
    for (int channel = 0; channel < 3; channel++)
        rgb[channel] = fminf(fmaxf(rgb[channel], 0.0f), 1.0f);
    flip_colour_to_hunt_lab(rgb, lab);
}

static float largest_distance(void) {
    float green[3], blue[3];
    flip_colour_to_hunt_lab((float[3]){0.0f, 1.0f, 0.0f}, green);
    flip_colour_to_hunt_lab((float[3]){0.0f, 0.0f, 1.0f}, blue);
    return powf(flip_colour_distance(green, blue), COLOUR_EXPONENT);
}

/// Most distances are small: they get the larger share of [0, 1].
static float redistribute(float distance, float largest) {
    const float knee = COLOUR_SHARE * largest;
    if (distance < knee)
        return distance * ERROR_SHARE / knee;
    return ERROR_SHARE + (distance - knee) / (largest - knee) * (1.0f - ERROR_SHARE);
}

static float texel_error(const flip_job *job, size_t index) {
    const flip_view *a = &job->views[0], *b = &job->views[1];
    float lab_a[3], lab_b[3];
    perceived_colour(a, index, lab_a);
    perceived_colour(b, index, lab_b);
    float distance = powf(flip_colour_distance(lab_a, lab_b), COLOUR_EXPONENT);
    float colour = redistribute(distance, job->largest_distance);
    float feature =
        fmaxf(fabsf(a->edges[index] - b->edges[index]), fabsf(a->points[index] - b->points[index]));
    feature = powf(feature * (float)M_SQRT1_2, FEATURE_EXPONENT);
    return fminf(powf(colour, 1.0f - feature), 1.0f);
}

// ---------------------------------------------------------------------------------------------
// Jobs

static lobe_result allocate(flip_job *job, const lobe_host *host) {
    enum { PLANES = 2 * 5 + 3, ROWS = 4 };
    size_t plane = job->width * job->height;
    size_t padded = job->width + 2 * CONVOLUTION_MAXIMUM_RADIUS;
    job->memory = malloc((PLANES * plane + ROWS * job->width + padded) * sizeof *job->memory);
    if (job->memory == NULL) {
        lobe_host_log(host, LOBE_LOG_ERROR, "FLIP: out of memory for images of %zux%zu", job->width,
                      job->height);
        return LOBE_ERROR_OUT_OF_MEMORY;
    }
    float *next = job->memory;
    for (int view = 0; view < 2; view++) {
        for (int channel = 0; channel < 3; channel++, next += plane)
            job->views[view].opponent[channel] = next;
        job->views[view].edges = next;
        job->views[view].points = next + plane;
        next += 2 * plane;
    }
    for (int index = 0; index < 3; index++, next += plane)
        job->scratch[index] = next;
    for (int index = 0; index < ROWS; index++, next += job->width)
        job->rows[index] = next;
    job->padded = next;
    return LOBE_OK;
}

static lobe_result begin(flip_job *job, const lobe_image *reference, double pixels_per_degree,
                         const lobe_host *host, lobe_image *errors) {
    *job = (flip_job){.width = reference->width, .height = reference->height};
    *errors = (lobe_image){0};
    lobe_result result = allocate(job, host);
    if (result != LOBE_OK)
        return result;
    build_sensitivity(&job->filters, pixels_per_degree);
    build_detectors(&job->filters, pixels_per_degree);
    job->largest_distance = largest_distance();
    return lobe_image_allocate(errors, LOBE_FORMAT_R32_FLOAT, reference->width, reference->height,
                               host);
}

/// Raises each error to that of this exposure if that is larger.
static void accumulate(flip_job *job, const lobe_image *test, const lobe_image *reference,
                       flip_curve curve, float gain, lobe_image *errors) {
    view_image(job, test, curve, gain, &job->views[0]);
    view_image(job, reference, curve, gain, &job->views[1]);
    float *texels = errors->texels;
    for (size_t index = 0; index < job->width * job->height; index++)
        texels[index] = fmaxf(texels[index], texel_error(job, index));
}

lobe_result flip_low_dynamic_range(const lobe_image *test, const lobe_image *reference,
                                   double pixels_per_degree, const lobe_host *host,
                                   lobe_image *errors) {
    flip_job job;
    lobe_result result = begin(&job, reference, pixels_per_degree, host, errors);
    if (result == LOBE_OK)
        accumulate(&job, test, reference, clamp, 1.0f, errors);
    free(job.memory);
    return result;
}

// Andersson, Nilsson, Shirley, Akenine-Möller, 2021, "Visualizing Errors in Rendered High Dynamic
// Range Images": the largest error over exposures.
lobe_result flip_high_dynamic_range(const lobe_image *test, const lobe_image *reference,
                                    double pixels_per_degree, const lobe_host *host,
                                    lobe_image *errors) {
    flip_job job;
    flip_exposures exposures;
    lobe_result result = begin(&job, reference, pixels_per_degree, host, errors);
    if (result == LOBE_OK)
        result = flip_choose_exposures(reference, host, &exposures);
    for (unsigned index = 0; result == LOBE_OK && index < exposures.count; index++) {
        double share = exposures.count > 1 ? (double)index / (exposures.count - 1) : 0.0;
        double stops = exposures.start + share * (exposures.stop - exposures.start);
        accumulate(&job, test, reference, flip_tone_map, (float)exp2(stops), errors);
    }
    if (result != LOBE_OK)
        lobe_image_free(errors);
    free(job.memory);
    return result;
}

double flip_mean(const lobe_image *errors, const bool *pixels) {
    size_t size = (size_t)errors->width * errors->height, count = 0;
    const float *texels = errors->texels;
    double sum = 0.0;
    for (size_t index = 0; index < size; index++) {
        if (pixels != NULL && !pixels[index])
            continue;
        sum += texels[index];
        count++;
    }
    return sum / (double)count;
}
