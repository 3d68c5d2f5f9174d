#ifndef PASSES_OCEAN_OCEAN_CHECK_H
#define PASSES_OCEAN_OCEAN_CHECK_H

#include <lobe/ocean.h>

/// LOBE_ERROR_INVALID_ARGUMENT, with one line, unless all numbers are within their ranges.
lobe_result passes_ocean_check(const lobe_ocean_parameters *parameters, const lobe_host *host);

#endif
