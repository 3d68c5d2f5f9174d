#include "passes/maps/tile_knobs.h"

#include "passes/context/knob_values.h"
#include "passes/context/sample_count.h"
#include "passes/maps/filtered_maps.h"

static const char *const extents[] = {"whole", "seen", NULL};
static const char *const sample_numbers[] = {"all", "4", "16", "64", NULL};

const filter_knob passes_knob_built = {
    .description = {.name = "built",
                    .summary = "what is made of the material's map: the whole; or, with samples=1, "
                               "only tiles that pixels read, for large maps that change often",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 1,
                    .choices = extents},
    .needs = "fragmentStoresAndAtomics",
};
const filter_knob passes_knob_texel_samples = {
    .description = {.name = "texel_samples",
                    .summary = "with built=seen: how many points of the base maps a texel is "
                               "made from where it covers more, and bins are fitted to a part of "
                               "the texels; all: exact means of all",
                    .kind = LOBE_KNOB_CHOICE,
                    .maximum = 3,
                    .choices = sample_numbers},
};

bool passes_wants_seen_tiles(const filter_context *context) {
    const sample_count samples = passes_sample_count(context);
    return passes_knob_choice(context, &passes_knob_built) > 0 && samples.most == 1 &&
           passes_knob_choice(context, &passes_knob_anisotropy) == 1;
}

uint32_t passes_texel_samples(const filter_context *context) {
    const uint32_t choice = passes_knob_choice(context, &passes_knob_texel_samples);
    return context->marks && choice > 0 ? 1u << choice : 0;
}
