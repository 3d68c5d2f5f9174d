#include "passes/filters/moments/footprints/footprint.h"

#include <math.h>

#include <lobe/colour.h>

#include "passes/upload/colours/material_colours.h"
#include "shaders/interface/mirrored.h"

/// Variances of half vectors under the lamp and under the broad light: what they show is at least
/// 0.01 and 0.1 radians wide.
static const double variances[FOOTPRINT_LIGHTS] = {0.0001, 0.01};

/// In means over all half vectors: where the lobes reflect more of the lamp, errors count relative
/// to what they reflect. Otherwise nothing but the peaks of the sharpest lobes would count, which
/// pixels seldom see.
static const double bright = 40;

/// A Gaussian: peak exp(-1/2 d^T inverse d).
typedef struct bell {
    double place[2], peak, inverse[3];
} bell;

static double evaluate(const bell *b, const double place[2]) {
    double x = place[0] - b->place[0], y = place[1] - b->place[1];
    double square = b->inverse[0] * x * x + b->inverse[1] * y * y + 2 * b->inverse[2] * x * y;
    return square < 60 ? b->peak * exp(-0.5 * square) : 0;
}

// ---------------------------------------------------------------------------------------------
// The truth

static bell bell_of_lobe(const plane_sample *lobe, double light) {
    const double variance = lobe->variance + light;
    double covariance[3];
    bell result = {.place = {lobe->place[0], lobe->place[1]},
                   .peak = lobe->weight * lobe->mass / (2 * M_PI * variance)};
    passes_plane_distortion(lobe->place, covariance, result.inverse);
    for (int i = 0; i < 3; i++)
        result.inverse[i] /= variance;
    return result;
}

/// A place at random from a lobe.
static void draw_from_lobe(const plane_sample *lobe, double light, const double numbers[2],
                           double place[2]) {
    double radius = sqrt(-2 * (lobe->variance + light) * log(1 - 0.9999 * numbers[0]));
    double angle = 2 * M_PI * numbers[1], covariance[3], inverse[3];
    passes_plane_distortion(lobe->place, covariance, inverse);
    // Any root of the covariance will do: Cholesky's.
    double first = sqrt(covariance[0]), shared = covariance[2] / first;
    double second = sqrt(fmax(covariance[1] - shared * shared, 0));
    double x = radius * cos(angle), y = radius * sin(angle);
    place[0] = lobe->place[0] + first * x;
    place[1] = lobe->place[1] + shared * x + second * y;
}

/// Lobes are chosen by their mass, in equal steps through all of them.
static void draw_places(const footprint *patch, footprint_light *light) {
    double total = 0, sum = 0;
    for (uint32_t i = 0; i < patch->count; i++)
        total += patch->lobes[i].weight * patch->lobes[i].mass;
    uint32_t lobe = 0;
    for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
        double target = (i + 0.5) / FOOTPRINT_PLACES * total;
        while (lobe + 1 < patch->count &&
               sum + patch->lobes[lobe].weight * patch->lobes[lobe].mass < target) {
            sum += patch->lobes[lobe].weight * patch->lobes[lobe].mass;
            ++lobe;
        }
        // Evenly spread (Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences).
        const double numbers[2] = {fmod(0.5 + 0.7548776662466927 * i, 1),
                                   fmod(0.5 + 0.5698402909980532 * i, 1)};
        draw_from_lobe(&patch->lobes[lobe], light->variance, numbers, light->places[i]);
    }
}

/// How often pixels see a half vector: under a viewer and lights that are spread over the
/// hemisphere hardly any is steep.
static double weight_of(const double place[2]) {
    double cosine = 1 - 0.5 * (place[0] * place[0] + place[1] * place[1]);
    double square = cosine > 0 ? cosine * cosine : 0;
    return fmax(square * square, 1e-6);
}

/// The integral of weight_of.
static const double all_weights = 2 * M_PI / 5;

static void find_truth(const footprint *patch, footprint_light *light) {
    for (uint32_t k = 0; k < patch->count; k++) {
        const plane_sample *lobe = &patch->lobes[k];
        const bell shape = bell_of_lobe(lobe, light->variance);
        for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
            double value = evaluate(&shape, light->places[i]);
            light->densities[i] += value;
            for (int j = 0; j < 3; j++)
                light->truth[i][j] += value * lobe->specular[j];
        }
    }
}

static double mean_of_channels(const double colour[3]) {
    return (colour[0] + colour[1] + colour[2]) / 3;
}

/// What sums count places as: integrals over half vectors, of squares relative to what is bright.
static void find_parts(const footprint *patch, footprint_light *light) {
    const double diffuse = mean_of_channels(patch->diffuse);
    double sum = 0;
    for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
        light->parts[i] =
            weight_of(light->places[i]) / (FOOTPRINT_PLACES * fmax(light->densities[i], 1e-30));
        sum += light->parts[i] * mean_of_channels(light->truth[i]);
    }
    const double level = bright * (sum / all_weights + diffuse);
    if (light->variance >= variances[1])
        return;
    for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
        const double ratio = (mean_of_channels(light->truth[i]) + diffuse) / fmax(level, 1e-30);
        light->parts[i] /= 1 + ratio * ratio;
    }
}

/// The square of Lambert's part, integrated over half vectors.
static double square_of_diffuse(const footprint *patch) {
    double sum = 0;
    for (int j = 0; j < 3; j++)
        sum += all_weights * patch->diffuse[j] * patch->diffuse[j];
    return sum;
}

/// Lambert's part, too: what a lobe adds to that hardly shows where it is darker.
static void find_squares(const footprint *patch, footprint_light *light) {
    light->shown = light->whites = 0;
    for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
        const double part = light->parts[i], white = light->densities[i];
        for (int j = 0; j < 3; j++)
            light->shown +=
                part * light->truth[i][j] * (light->truth[i][j] + 2 * patch->diffuse[j]);
        light->whites += part * 3 * white * white;
    }
    light->shown += square_of_diffuse(patch);
}

// ---------------------------------------------------------------------------------------------
// Colours of averaged maps

/// What is not metal, below what it reflects.
static double diffuse_of(double albedo, double metallic, bool microfacet) {
    double reflectance = microfacet ? passes_reflectance_of(albedo, metallic) : 0;
    return albedo * (1 - metallic) * (1 - reflectance);
}

/// From a diffuse colour to what Lambert's part reflects in units of a distribution's density: of
/// 1/pi times a usual cosine, and a specular lobe reflects a quarter of that density (Walter et al.
/// 2007, Eq. 20), a half-vector lobe all of it.
static double lambert_scale(bool microfacet) {
    static const double usual_cosine = 0.7;
    return usual_cosine * (microfacet ? 4 : 1) / M_PI;
}

/// Averaged maps multiply means: the colour of metal by how much is metal.
static void average_colours(footprint *patch) {
    const bool microfacet = patch->microfacet;
    double albedo[3] = {0}, specular[3] = {0}, diffuse[3] = {0}, metallic = 0, total = 0;
    for (uint32_t k = 0; k < patch->count; k++) {
        const plane_sample *lobe = &patch->lobes[k];
        total += lobe->weight;
        metallic += lobe->weight * lobe->metallic;
        for (int j = 0; j < 3; j++) {
            albedo[j] += lobe->weight * lobe->albedo[j];
            specular[j] += lobe->weight * lobe->specular[j];
            diffuse[j] += lobe->weight * diffuse_of(lobe->albedo[j], lobe->metallic, microfacet);
        }
    }
    double error = 0, all = 0;
    for (int j = 0; j < 3; j++) {
        double mean = diffuse_of(albedo[j] / total, metallic / total, microfacet);
        patch->colour[j] = microfacet ? passes_reflectance_of(albedo[j] / total, metallic / total)
                                      : specular[j] / total;
        error += fabs(mean - diffuse[j] / total);
        all += (diffuse[j] + specular[j]) / total;
    }
    patch->diffuse_error = all > 0 ? error / all : 0;
    for (int j = 0; j < 3; j++)
        patch->diffuse[j] = lambert_scale(microfacet) * patch->base_colour[j] * diffuse[j] / total;
}

/// As shaders/filters/moments/mirrored.glsl.
static double mirrored_by(const footprint *patch, const plane_sample *lobe) {
    const float f0[] = {(float)lobe->specular[0], (float)lobe->specular[1],
                        (float)lobe->specular[2]};
    const double luminance = (double)lobe_luminance(f0);
    return patch->microfacet ? luminance + LEAST_MIRRORED_BINS * (1 - luminance) : 1;
}

static bool mirrors_alike(const footprint *patch) {
    for (uint32_t k = 1; k < patch->count; k++)
        if (mirrored_by(patch, &patch->lobes[k]) != mirrored_by(patch, &patch->lobes[0]))
            return false;
    return true;
}

bool passes_footprint_is_sharp(double variance) {
    return variance < variances[1];
}

void passes_footprint_normalise(plane_sample *lobes, uint32_t count) {
    double total = 0;
    for (uint32_t k = 0; k < count; k++)
        total += lobes[k].weight;
    for (uint32_t k = 0; k < count; k++)
        lobes[k].weight /= total;
}

void passes_footprint_complete(footprint *patch) {
    passes_footprint_normalise(patch->lobes, patch->count);
    average_colours(patch);
    patch->facing = (facing_light){0};
    for (uint32_t k = 0; patch->microfacet && k < patch->count; k++)
        passes_facing_add_sample(&patch->facing, &patch->lobes[k], patch->lobes[k].weight);
    for (uint32_t i = 0; i < patch->light_count; i++) {
        footprint_light *light = &patch->lights[i];
        light->variance = variances[i];
        draw_places(patch, light);
        find_truth(patch, light);
        find_parts(patch, light);
        find_squares(patch, light);
    }
    patch->mirrors_alike = mirrors_alike(patch);
}

// ---------------------------------------------------------------------------------------------
// Bins

/// Sums over the lobes of a bin, by what each counts.
typedef struct shape_sums {
    plane_sums places;
    double sharpness;
} shape_sums;

/// The sums that a pixel fetches of a bin: of its mass or, if it has a colour, of what that
/// mirrors.
typedef struct bin_sums {
    shape_sums by_mass, by_mirrored;
    double colour[3];
} bin_sums;

/// The bin about as a pixel sees it (shaders/filters/moments/bins.glsl): base lobes of two widths;
/// the tails of GGX are left out.
typedef struct footprint_bin {
    bell terms[2];
    double colour[3];
} footprint_bin;

static bell bell_of_bin(const plane_sums *places, double mass, double base) {
    double covariance[3], distortion[3], inverse[3];
    bell result;
    for (int i = 0; i < 2; i++)
        result.place[i] = places->place[i] / places->weight;
    passes_plane_distortion(result.place, distortion, inverse);
    passes_plane_sums_covariance(places, covariance);
    for (int i = 0; i < 3; i++)
        covariance[i] += base * distortion[i];
    double determinant = fmax(covariance[0] * covariance[1] - covariance[2] * covariance[2], 1e-16);
    result.peak = 0.5 * mass / (2 * M_PI * sqrt(determinant));
    result.inverse[0] = covariance[1] / determinant;
    result.inverse[1] = covariance[0] / determinant;
    result.inverse[2] = -covariance[2] / determinant;
    return result;
}

/// Two Gaussians with the mean sharpness and the mean variance of the base lobes; or of log-normal
/// deviations with these.
static footprint_bin make_bin(const shape_sums *sums, const double colour[3], double mass,
                              bool log_normal, double light) {
    const double weight = sums->places.weight, sharpness = sums->sharpness / weight;
    const double ratio = fmax(sums->places.variance / weight * sharpness * sharpness, 1);
    const double square = 0.25 + 0.25 * sqrt(1 + 8 * ratio);
    const double median = (log_normal ? cbrt(ratio) : square) / (sharpness * sharpness);
    const double varies = log_normal ? sqrt(fmin(log(ratio) / 3, 0.64)) : acosh(sqrt(square));
    const double factor = exp(2 * varies);
    return (footprint_bin){.terms = {bell_of_bin(&sums->places, mass, median / factor + light),
                                     bell_of_bin(&sums->places, mass, median * factor + light)},
                           .colour = {colour[0] / mass, colour[1] / mass, colour[2] / mass}};
}

static double evaluate_bin(const footprint_bin *bin, const double place[2]) {
    return evaluate(&bin->terms[0], place) + evaluate(&bin->terms[1], place);
}

static void add_to_shape(shape_sums *sums, const plane_sample *lobe, double counts) {
    passes_plane_sums_add(&sums->places, lobe, counts);
    sums->sharpness += counts / sqrt(lobe->variance);
}

/// How many there are.
static uint32_t collect(const footprint *patch, const plane_sample *lobes, uint32_t lobe_count,
                        const plane_mixture *m, bin_sums sums[MOMENT_MAXIMUM_BINS]) {
    for (uint32_t i = 0; i < lobe_count; i++) {
        const plane_sample *lobe = &lobes[i];
        double members[MOMENT_MAXIMUM_BINS];
        passes_mixture_share(m, lobe, members);
        for (uint32_t k = 0; k < m->count; k++) {
            double mass = lobe->weight * lobe->mass * members[k];
            add_to_shape(&sums[k].by_mass, lobe, mass);
            if (!patch->mirrors_alike)
                add_to_shape(&sums[k].by_mirrored, lobe, mass * mirrored_by(patch, lobe));
            for (int j = 0; j < 3; j++)
                sums[k].colour[j] += mass * lobe->specular[j];
        }
    }
    uint32_t count = 0;
    for (uint32_t k = 0; k < m->count; k++)
        if (sums[k].by_mass.places.weight > 1e-6)
            sums[count++] = sums[k];
    return count;
}

static footprint_error compare_light(const footprint *patch, const footprint_light *light,
                                     const bin_sums *sums, uint32_t count) {
    footprint_bin bins[MOMENT_MAXIMUM_BINS], mirrored_bins[MOMENT_MAXIMUM_BINS];
    footprint_error error = {0};
    for (uint32_t k = 0; k < count; k++) {
        const double *colour = sums[k].colour, mass = sums[k].by_mass.places.weight;
        bins[k] = make_bin(&sums[k].by_mass, colour, mass, patch->log_normal, light->variance);
        if (!patch->mirrors_alike)
            mirrored_bins[k] =
                make_bin(&sums[k].by_mirrored, colour, mass, patch->log_normal, light->variance);
    }
    for (uint32_t i = 0; i < FOOTPRINT_PLACES; i++) {
        double all = 0, coloured[3] = {0};
        for (uint32_t k = 0; k < count; k++) {
            const double plain = evaluate_bin(&bins[k], light->places[i]);
            const double value =
                patch->mirrors_alike ? plain : evaluate_bin(&mirrored_bins[k], light->places[i]);
            all += plain;
            for (int j = 0; j < 3; j++)
                coloured[j] += value * bins[k].colour[j];
        }
        const double part = light->parts[i];
        for (int j = 0; j < 3; j++) {
            double truth = light->truth[i][j];
            double mean = all * patch->colour[j] - truth, own = coloured[j] - truth;
            error.mean_colour += part * mean * mean;
            error.bin_colours += part * own * own;
        }
    }
    return error;
}

/// Of Lambert's part, which half-vector lobes light about the mean normal, whatever the bins.
static double compare_diffuse(const footprint *patch, const bin_sums *sums, uint32_t count) {
    if (!patch->microfacet)
        return 0;
    double mass = 0;
    for (uint32_t k = 0; k < count; k++)
        mass += sums[k].by_mass.places.weight;
    facing_light facing = {0};
    for (uint32_t k = 0; k < count; k++)
        passes_facing_add_bin(&facing, &sums[k].by_mass.places,
                              sums[k].by_mass.places.weight / mass);
    return square_of_diffuse(patch) * passes_facing_error(&facing, &patch->facing);
}

void passes_footprint_compare(const footprint *patch, const plane_sample *lobes,
                              uint32_t lobe_count, const plane_mixture *mixture,
                              footprint_error errors[FOOTPRINT_LIGHTS]) {
    bin_sums sums[MOMENT_MAXIMUM_BINS] = {0};
    const uint32_t count = collect(patch, lobes, lobe_count, mixture, sums);
    const double diffuse = compare_diffuse(patch, sums, count);
    for (uint32_t i = 0; i < patch->light_count; i++) {
        errors[i] = compare_light(patch, &patch->lights[i], sums, count);
        errors[i].mean_colour += diffuse;
        errors[i].bin_colours += diffuse;
    }
}
