#include "passes/filters/mixture/projected_map.h"

#include "passes/filters/mixture/record.h"
#include "passes/maps/lobe_map.h"
#include "shaders/interface/moment_bins.h"

void passes_projected_map_build(const filter_context *context, size_t instance,
                                const mixture_kind *kind, const void *prepared,
                                filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    moment_map mixture;
    const bool has = passes_mixture_build(context, material, kind, prepared, &mixture);
    passes_lobe_map_bind(context, material, "moment_map", has ? &mixture.map : NULL, kind->format,
                         appearance);
    passes_appearance_specialise(appearance, SPECIALISE_BINS, kind->components);
}
