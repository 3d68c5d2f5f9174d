#include "tests/reference/mixture/lobe_mixture.h"

#include <math.h>

#include "tests/reference/lobe/lobe_cluster.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/vector.h"

static void add(double *texel, const double vector[3], double fourth) {
    for (int i = 0; i < 3; i++)
        texel[i] += vector[i];
    texel[3] += fourth;
}

void reference_add_lobe(const reference_layers *mixture, uint32_t x, uint32_t y,
                        const reference_lobe *lobe) {
    double length = lobe->share * reference_mean_resultant_length(lobe->concentration);
    const double r[3] = {length * lobe->axis[0], length * lobe->axis[1], length * lobe->axis[2]};
    uint32_t cluster = reference_cluster_of(lobe->axis, false);
    const uint32_t layers[3] = {REFERENCE_MIXTURE_LAYER_ONE,
                                REFERENCE_MIXTURE_LAYER_SECTORS + cluster / 2,
                                REFERENCE_MIXTURE_LAYER_HALVES + cluster};
    for (int i = 0; i < 3; i++)
        add(reference_texel(mixture, x, y, layers[i]), r, lobe->share);
    reference_texel(mixture, x, y, REFERENCE_MIXTURE_LAYER_MEAN)[3] +=
        lobe->share * reference_mean_resultant_complement(lobe->concentration);
}

void reference_add_normal(const reference_layers *mixture, uint32_t x, uint32_t y,
                          const double normal[3]) {
    add(reference_texel(mixture, x, y, REFERENCE_MIXTURE_LAYER_MEAN), normal, 0);
}

double reference_evaluate_cluster(const reference_layers *mixture, uint32_t x, uint32_t y,
                                  uint32_t layer, const double direction[3]) {
    const double *texel = reference_texel(mixture, x, y, layer);
    double weight = texel[3], length = reference_length(texel);
    if (weight <= 0)
        return 0;
    if (length == 0)
        return weight * 0.25 / M_PI;
    const double mean[3] = {texel[0] / length, texel[1] / length, texel[2] / length};
    // No sharper than the base lobes may be: shaders/lib/number/constants.glsl.
    double complement = fmax(1 - length / weight, 1e-6);
    return weight * reference_von_mises_fisher(direction, mean,
                                               reference_concentration_from_complement(complement));
}

double reference_evaluate_mixture(const reference_layers *mixture, uint32_t x, uint32_t y,
                                  uint32_t subdivision, const double direction[3]) {
    static const uint32_t first[] = {REFERENCE_MIXTURE_LAYER_ONE, REFERENCE_MIXTURE_LAYER_SECTORS,
                                     REFERENCE_MIXTURE_LAYER_HALVES};
    static const uint32_t count[] = {1, 4, 8};
    double sum = 0;
    for (uint32_t i = 0; i < count[subdivision]; i++)
        sum += reference_evaluate_cluster(mixture, x, y, first[subdivision] + i, direction);
    return sum;
}
