#include "passes/ocean/ocean_check.h"

#include <math.h>
#include <stdio.h>

static lobe_result fail(const lobe_host *host, const char *name, double value, const char *range) {
    return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT, "ocean: %s is %g; expected %s", name,
                          value, range);
}

static lobe_result check_number(const lobe_host *host, const char *name, double value,
                                double minimum, double maximum) {
    char range[64];
    snprintf(range, sizeof range, "%g to %g", minimum, maximum);
    // False for NaN, too.
    return value >= minimum && value <= maximum ? LOBE_OK : fail(host, name, value, range);
}

static lobe_result check_lengths(const lobe_ocean_parameters *p, const lobe_host *host) {
    for (uint32_t i = 0; i < p->layers; i++) {
        char name[32];
        snprintf(name, sizeof name, "lengths[%u]", i);
        lobe_result result = check_number(host, name, p->lengths[i], 1, 1e5);
        if (result != LOBE_OK)
            return result;
        if (i > 0 && p->lengths[i] > 0.5f * p->lengths[i - 1])
            return fail(host, name, p->lengths[i], "at most half of the one before");
    }
    return LOBE_OK;
}

lobe_result passes_ocean_check(const lobe_ocean_parameters *p, const lobe_host *host) {
    if (!p)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "ocean: parameters must not be NULL");
    const struct {
        const char *name;
        double value, minimum, maximum;
    } numbers[] = {
        {"spectrum", (double)p->spectrum, LOBE_OCEAN_ELFOUHAILY, LOBE_OCEAN_PIERSON_MOSKOWITZ},
        {"spreading", (double)p->spreading, LOBE_OCEAN_SPREADING_SYMMETRIC,
         LOBE_OCEAN_SPREADING_COSINE},
        {"wind_speed", p->wind_speed, 0, 60},
        {"wind_direction", p->wind_direction, -1e3, 1e3},
        {"fetch", p->fetch, 1e3, 1e8},
        {"size", p->size, 8, 1024},
        {"layers", p->layers, 1, LOBE_OCEAN_MAXIMUM_LAYERS},
        {"choppiness", p->choppiness, 0, 2},
    };
    lobe_result result = LOBE_OK;
    for (size_t i = 0; !result && i < sizeof numbers / sizeof *numbers; i++)
        result = check_number(host, numbers[i].name, numbers[i].value, numbers[i].minimum,
                              numbers[i].maximum);
    if (!result && (p->size & (p->size - 1)) != 0)
        result = fail(host, "size", p->size, "a power of two");
    return result ? result : check_lengths(p, host);
}
