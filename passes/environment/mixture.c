#include "passes/environment/mixture.h"

#include <lobe/environment_maps.h>

#include <math.h>

#include "shaders/interface/environment/environment.h"

/// Weight of the lobe of concentration kappa in a GGX lobe.
///
/// Walter et al., 2007, Eq. 33, with h half way between the axis and a direction theta away from
/// it, x = 1 - cos theta, alpha^2 = 1/(2 kappa_l) and b = (1/alpha^2 - 1)/2 = kappa_l - 1/2:
///   D(theta/2) = 1/(pi alpha^2 (1 + b x)^2)
///              = 1/(pi alpha^2) integral of s exp(-s) exp(-s b x) ds, s from 0 to infinity,
/// since 1/y^2 = integral of s exp(-s y) ds. Each exp(-s b x) is a von Mises-Fisher lobe of
/// concentration kappa = s b up to its norm, so that with both lobes normalised over the sphere
///   GGX = integral of exp(-s) (1 - exp(-2 s b))/(1 - alpha^2) vMF(s b) ds.
/// In log s the integrand is so smooth that a sum with steps of log 2 is exact to 1e-4.
static double weight_of_lobe(double concentration, double ggx_concentration) {
    double b = ggx_concentration - 0.5, s = concentration / b;
    return s * exp(-s) * -expm1(-2 * concentration);
}

/// At alpha = 1 and above, the lobe is the mean of all directions.
static void find_weights(uint32_t width, uint32_t level,
                         struct environment_mixture_constants *constants) {
    double kappa = lobe_environment_level_concentration(width, level), sum = 0;
    uint32_t count = constants->levels;
    double weights[2 * ENVIRONMENT_LEVELS] = {0}, sharpest = 0;
    for (uint32_t i = 0; kappa > 0.5 && i < 2 * count; i++)
        sum += weights[i] = weight_of_lobe(kappa * exp2(1 - (double)i), kappa);
    for (int i = 2; kappa > 0.5 && i < 6; i++)
        sharpest += weight_of_lobe(kappa * exp2(i), kappa);
    sum += sharpest;
    if (sum == 0)
        sum = weights[2 * count - 1] = 1;
    constants->sharpest = (float)(sharpest / sum);
    for (uint32_t i = 0; i < count; i++) {
        constants->between[i] = (float)(weights[2 * i] / sum);
        constants->lobes[i] = (float)(weights[2 * i + 1] / sum);
    }
}

lobe_pass *passes_environment_mixture(lobe_graph *graph, const prefiltering_sources *sources,
                                      const reduced_map *lobes, const reduced_map *between,
                                      reduced_map *cube, uint32_t level, uint32_t first_face,
                                      uint32_t face_count) {
    uint32_t width = cube->width >> level;
    struct environment_mixture_constants constants = {
        .width = width, .levels = cube->levels - level, .first_face = first_face};
    find_weights(cube->width, level, &constants);
    reduced_map sharpest = {.width = width, .height = width, .layers = 6, .levels = 1};
    sharpest.resource =
        lobe_graph_image(graph, &(lobe_image_description){.name = "sharpest lobes of a GGX lobe",
                                                          .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                          .width = width,
                                                          .height = width,
                                                          .layers = 6});
    passes_environment_prefiltering(graph, sources, &sharpest, 0, first_face, face_count,
                                    4 * lobe_environment_level_concentration(cube->width, level));
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_mixture");
    lobe_pass_read(pass, &(lobe_binding){"sharpest", sharpest.resource,
                                         .range = {0, 1, first_face, face_count}});
    lobe_range coarser = {level, cube->levels - level, 0, 6};
    lobe_sampler linear = {.texels = LOBE_SAMPLE_LINEAR};
    lobe_pass_read(pass, &(lobe_binding){"between", between->resource, coarser, linear});
    lobe_pass_read(pass, &(lobe_binding){"lobes", lobes->resource, coarser, linear});
    cube->resource =
        lobe_pass_write(pass, &(lobe_binding){"target", cube->resource,
                                              .range = {level, 1, first_face, face_count}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/mixture.comp",
                                              .threads = {width, width, face_count},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return pass;
}
