#ifndef TESTS_PASSES_FILTERS_DISPLACED_RELIEF_WAVES_H
#define TESTS_PASSES_FILTERS_DISPLACED_RELIEF_WAVES_H

#include "tests/passes/support/fixture.h"

/// Draws waves that are wider than a pixel, under a sun, with `texels` of their map a pixel. Fails
/// unless the filter's picture is within `bound` (relative L2) of the reference's, and closer to it
/// than that of a flat carrier. `settings`: of the filter, ended by NULL.
void relief_waves_check(fixture *f, const char *filter, const char *const *settings,
                        uint32_t texels, double bound);

#endif
