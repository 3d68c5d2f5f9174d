#include "passes/filters/filter.h"
#include "shaders/interface/specialisation.h"

/// Off where nobody asks: this filter shows what one sample alone gives.
static const lobe_knob curvature_knob = {
    .name = "curvature",
    .summary = "how much of the surface's own curvature under a pixel widens its lobes; 0: none",
    .maximum = 4,
};
static const lobe_knob *const knobs[] = {&curvature_knob, NULL};

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    (void)instance;
    (void)prepared;
    passes_appearance_specialise_number(appearance, SPECIALISE_CURVATURE,
                                        (float)passes_filter_setting(context, "curvature"));
}

const lobe_filter passes_filter_direct = {
    .name = "direct",
    .summary = "one unfiltered sample of the maps: fast, and aliased",
    .paper = "",
    .shading = "direct",
    .knobs = knobs,
    .build = build,
};
