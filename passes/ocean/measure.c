#include <math.h>
#include <string.h>

#include "passes/ocean/layer.h"
#include "passes/ocean/ocean_check.h"

void lobe_ocean_default(lobe_ocean_parameters *parameters) {
    if (!parameters)
        return;
    *parameters = (lobe_ocean_parameters){
        .spectrum = LOBE_OCEAN_ELFOUHAILY,
        .spreading = LOBE_OCEAN_SPREADING_SYMMETRIC,
        .wind_speed = 10,
        .fetch = 1e6f,
        .size = 256,
        .layers = 3,
        .lengths = {512, 61, 7.3f},
        .choppiness = 1,
        .seed = 1,
    };
}

/// What is left of a covariance; rounding, and bands of few waves, must not make a variance
/// negative, or slopes more correlated than is possible.
static void subtract(double rest[3], const double part[3]) {
    for (int i = 0; i < 3; i++)
        rest[i] -= part[i];
    rest[0] = fmax(rest[0], 0);
    rest[1] = fmax(rest[1], 0);
    const double limit = sqrt(rest[0] * rest[1]);
    rest[2] = fmax(fmin(rest[2], limit), -limit);
}

static void store(const double covariance[3], float result[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = (float)covariance[i];
}

lobe_result lobe_ocean_measure(const lobe_ocean_parameters *parameters, const lobe_host *host,
                               lobe_ocean_slopes *slopes) {
    if (!slopes)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_ocean_measure: slopes must not be NULL");
    memset(slopes, 0, sizeof *slopes);
    const lobe_result result = passes_ocean_check(parameters, host);
    if (result != LOBE_OK)
        return result;
    const sea sea = passes_sea(parameters);
    double along_across[2], rest[3];
    passes_sea_slopes(&sea, 0, INFINITY, along_across);
    passes_sea_covariance(&sea, along_across, rest);
    store(rest, slopes->total);
    for (uint32_t i = 0; i < parameters->layers; i++) {
        const ocean_layer layer = passes_ocean_layer(parameters, i);
        double part[3];
        passes_ocean_layer_slopes(&layer, &sea, part);
        store(part, slopes->layers[i]);
        subtract(rest, part);
    }
    store(rest, slopes->rest);
    return LOBE_OK;
}
