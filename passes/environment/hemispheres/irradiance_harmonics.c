#include "passes/environment/hemispheres/irradiance_harmonics.h"

#include <lobe/environment_maps.h>

#include <math.h>

#include "shaders/interface/environment/irradiance_harmonics.h"

/// Texels along a face of the level that is projected, at most.
#define FINEST_WIDTH 64

/// Ramamoorthi, Hanrahan 2001, Eq. 8: the clamped cosine's factor of degree l.
static const double cosine_factor[3] = {M_PI, 2 * M_PI / 3, M_PI / 4};

/// Sloan 2008: l^2 (l + 1)^2, the square of the Laplacian's eigenvalue.
static double squared_eigenvalue(int degree) {
    double eigenvalue = degree * (degree + 1);
    return eigenvalue * eigenvalue;
}

/// Mean square over the sphere, up to a factor, of the Laplacian of a single light's irradiance.
static double squared_laplacian(double lambda) {
    double sum = 0;
    for (int degree = 1; degree < 3; degree++) {
        double square = squared_eigenvalue(degree);
        double amplitude = cosine_factor[degree] / (1 + lambda * square);
        sum += (2 * degree + 1) * square * amplitude * amplitude;
    }
    return sum;
}

double passes_harmonics_window(double window) {
    if (!(window > 0))
        return 0;
    double wanted = squared_laplacian(0) * (1 - window) * (1 - window);
    double low = 0, high = 1;
    while (squared_laplacian(high) > wanted && high < 1e6)
        high *= 2;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (squared_laplacian(middle) > wanted)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/// What a von Mises-Fisher lobe of a large concentration leaves of degree l: Mardia, Jupp 2000,
/// Directional Statistics, section 9.3.
static double lobe_factor(int degree, double concentration) {
    double first = 1 - 1 / concentration;
    return degree == 0 ? 1 : degree == 1 ? first : 1 - 3 * first / concentration;
}

static lobe_resource add_up_groups(lobe_graph *graph, lobe_resource sums, uint32_t count,
                                   double concentration, double window) {
    struct irradiance_harmonics_sum_constants constants = {.count = count};
    double lambda = passes_harmonics_window(window);
    for (int degree = 0; degree < 3; degree++)
        constants.band_factors[degree] =
            (float)(cosine_factor[degree] / (1 + lambda * squared_eigenvalue(degree)) /
                    lobe_factor(degree, concentration));
    lobe_resource harmonics = lobe_graph_buffer(
        graph, &(lobe_buffer_description){"environment irradiance harmonics",
                                          sizeof(struct irradiance_harmonics), .retained = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "irradiance_harmonics_sum");
    lobe_pass_read(pass, &(lobe_binding){.name = "group_sums_block", .resource = sums});
    harmonics =
        lobe_pass_write(pass, &(lobe_binding){.name = "harmonics_block", .resource = harmonics});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/irradiance_harmonics_sum.comp",
                                              .threads = {HARMONICS_GROUP_SIZE},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return harmonics;
}

static lobe_resource map_remainder(lobe_graph *graph, lobe_resource harmonics,
                                   const environment_means *means, double window) {
    const struct irradiance_remainder_constants constants = {.size = means->size,
                                                             .is_zero = window > 0};
    lobe_resource map = lobe_graph_image(
        graph, &(lobe_image_description){.name = "environment irradiance remainder",
                                         .format = LOBE_FORMAT_RGBA32_FLOAT,
                                         .width = HARMONICS_REMAINDER_WIDTH,
                                         .height = HARMONICS_REMAINDER_WIDTH,
                                         .retained = true,
                                         .shared = true});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "irradiance_remainder");
    lobe_pass_read(pass,
                   &(lobe_binding){"environment", means->cube, .range = {means->level, 1, 0, 6}});
    lobe_pass_read(pass, &(lobe_binding){.name = "harmonics_block", .resource = harmonics});
    map = lobe_pass_write(pass, &(lobe_binding){.name = "remainder_map", .resource = map});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "environment/irradiance_remainder.comp",
                               .threads = {HARMONICS_REMAINDER_WIDTH * HARMONICS_REMAINDER_WIDTH},
                               .constants = &constants,
                               .constants_size = sizeof constants});
    return map;
}

irradiance_maps passes_irradiance_harmonics(lobe_graph *graph, irradiance_source source,
                                            const environment_means *means, double window) {
    uint32_t level = passes_irradiance_source_level(&source, FINEST_WIDTH);
    struct irradiance_harmonics_constants constants = {source.size >> level};
    uint32_t texels = 6 * constants.size * constants.size;
    uint32_t groups = (texels + HARMONICS_GROUP_TEXELS - 1) / HARMONICS_GROUP_TEXELS;
    lobe_resource sums = lobe_graph_buffer(
        graph, &(lobe_buffer_description){.name = "sums of harmonics",
                                          .size = (size_t)groups * HARMONICS * 4 * sizeof(float)});
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "irradiance_harmonics");
    lobe_pass_read(pass, &(lobe_binding){"environment", source.cube, .range = {level, 1, 0, 6}});
    sums = lobe_pass_write(pass, &(lobe_binding){.name = "group_sums_block", .resource = sums});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/irradiance_harmonics.comp",
                                              .threads = {groups * HARMONICS_GROUP_SIZE},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    double concentration =
        source.filtered ? lobe_environment_level_concentration(source.size, level) : INFINITY;
    lobe_resource harmonics = add_up_groups(graph, sums, groups, concentration, window);
    return (irradiance_maps){harmonics, map_remainder(graph, harmonics, means, window)};
}
