#include "passes/context/filter.h"
#include "passes/context/shared_knobs.h"
#include "passes/filters/displaced/relief.h"

static const filter_knob bounces_knob = {
    .description = {.name = "bounces",
                    .summary = "facets that a path of light meets at most; 1: no light between "
                               "facets",
                    .kind = LOBE_KNOB_INTEGER,
                    .minimum = 1,
                    .maximum = 64,
                    .initial = 32},
    .feeds = KNOB_FEEDS_CONSTANT(SPECIALISE_PATH_VERTICES),
};
static const filter_knob *const knobs[] = {&bounces_knob, NULL};

static void build(const filter_context *context, size_t instance, const void *prepared,
                  filtered_appearance *appearance) {
    (void)prepared;
    const uint32_t index = context->scene->instances[instance].material;
    const bool has_relief = passes_has_relief(&context->scene->materials[index]);
    passes_appearance_specialise(appearance, SPECIALISE_RELIEF, has_relief);
    if (!has_relief) {
        passes_relief_bind(NULL, context, appearance);
        return;
    }
    const relief relief = passes_relief(context, index, true);
    passes_relief_bind(&relief, context, appearance);
    appearance->bytes = relief.bytes;
    appearance->base_texels = (uint64_t)relief.constants.width * relief.constants.height;
}

static const char *ignores(const lobe_scene *scene, const device_material *material) {
    (void)scene;
    if (passes_has_relief(material) && material->material->normal_map.image >= 0)
        return "normals are those of its heights, not of its normal map";
    return NULL;
}

const lobe_filter passes_filter_displaced_reference = {
    .name = "displaced-reference",
    .summary = "the mean of many paths of light over the relief of height maps: the truth, slowly",
    .paper = "",
    .shading = "displaced_reference",
    .shading_cost = 20.0f,
    .knobs = knobs,
    .supersamples = true,
    .reads_heights = true,
    .moves_masks = true,
    .build = build,
    .ignores = ignores,
};
