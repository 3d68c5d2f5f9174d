#include "passes/filters/moments/plane_sample.h"

#include <math.h>

#include "passes/upload/colours/material_colours.h"

/// Of alpha^2, as GGX_SQUARE_MAXIMUM in shaders/lib/lobe/plane_lobe.glsl: there the mass stays.
static const double ggx_square_maximum = 0.9;

double passes_plane_mass_of_ggx(double concentration) {
    return 1 / (1 - fmin(2 / concentration, ggx_square_maximum));
}

double passes_plane_variance(const lobe_material *material, double concentration) {
    if (material->distribution != LOBE_DISTRIBUTION_GGX)
        return 1 / fmax(concentration, 0.2);
    return 0.5 * fmin(2 / concentration, 1) * passes_plane_mass_of_ggx(concentration);
}

/// The place of a unit direction.
static void place_of(const double direction[3], double place[2]) {
    double opposite = 1 + direction[2], scale = sqrt(2 / fmax(opposite, 1e-6));
    place[0] = opposite < 1e-6 ? 2 : direction[0] * scale;
    place[1] = opposite < 1e-6 ? 0 : direction[1] * scale;
}

void passes_plane_distortion(const double place[2], double covariance[3], double inverse[3]) {
    double square = place[0] * place[0] + place[1] * place[1];
    double c = fmax(1 - square / 4, 0.05);
    // With r = q / |q|: c r r^T + (I - r r^T) / c, and the same with 1/c.
    double along = (c - 1 / c) / fmax(square, 1e-12);
    for (int i = 0; i < 3; i++) {
        double product = i == 2 ? place[0] * place[1] : place[i] * place[i];
        covariance[i] = (i == 2 ? 0 : 1 / c) + along * product;
        inverse[i] = (i == 2 ? 0 : c) - along * product;
    }
}

uint32_t passes_plane_samples_read(const lobe_scene *scene, const device_material *material,
                                   double x, double y, double weight,
                                   plane_sample samples[LOBE_MATERIAL_MAXIMUM_LOBES]) {
    const lobe_material *source = material->material;
    const bool microfacet = source->model == LOBE_MATERIAL_MICROFACET;
    material_lobe lobes[LOBE_MATERIAL_MAXIMUM_LOBES];
    material_colours colours = {{1, 1, 1}, 0, {1, 1, 1}};
    const uint32_t count = passes_material_lobes_read(material, x, y, lobes);
    passes_material_colours_read(scene, material, (uint32_t)x, (uint32_t)y, &colours);
    for (uint32_t k = 0; k < count; k++) {
        plane_sample *sample = &samples[k];
        place_of(lobes[k].axis, sample->place);
        sample->variance = passes_plane_variance(source, lobes[k].concentration);
        bool ggx = source->distribution == LOBE_DISTRIBUTION_GGX;
        sample->mass = ggx ? passes_plane_mass_of_ggx(lobes[k].concentration) : 1;
        sample->weight = weight * lobes[k].weight;
        sample->metallic = colours.metallic;
        for (int i = 0; i < 3; i++) {
            double own =
                microfacet ? 1 : (double)source->lobes[k].colour[i] / fmax(lobes[k].weight, 1e-6);
            sample->specular[i] = colours.specular[i] * own;
            sample->albedo[i] = colours.albedo[i];
        }
    }
    return count;
}

void passes_plane_sums_add(plane_sums *sums, const plane_sample *s, double weight) {
    double x = s->place[0], y = s->place[1];
    sums->weight += weight;
    sums->place[0] += weight * x;
    sums->place[1] += weight * y;
    sums->moments[0] += weight * x * x;
    sums->moments[1] += weight * y * y;
    sums->moments[2] += weight * x * y;
    sums->variance += weight * s->variance;
}

void passes_plane_sums_covariance(const plane_sums *sums, double covariance[3]) {
    const double x = sums->place[0] / sums->weight, y = sums->place[1] / sums->weight;
    covariance[0] = fmax(sums->moments[0] / sums->weight - x * x, 0);
    covariance[1] = fmax(sums->moments[1] / sums->weight - y * y, 0);
    covariance[2] = sums->moments[2] / sums->weight - x * y;
}
