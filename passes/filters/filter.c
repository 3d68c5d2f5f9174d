#include "passes/filters/filter.h"

#include <string.h>

double passes_filter_setting(const filter_context *context, const char *knob) {
    return lobe_settings_get(context->filter, context->settings, knob);
}

void passes_appearance_bind(filtered_appearance *appearance, const char *name,
                            lobe_resource resource, lobe_sampler sampler) {
    if (appearance->binding_count == FILTER_MAXIMUM_BINDINGS) {
        lobe_graph_fail(appearance->graph, LOBE_ERROR_LIMIT,
                        "the filter binds '%s' after %d other resources, which is the most", name,
                        FILTER_MAXIMUM_BINDINGS);
        return;
    }
    appearance->bindings[appearance->binding_count++] =
        (lobe_binding){.name = name, .resource = resource, .sampler = sampler};
}

void passes_appearance_specialise(filtered_appearance *appearance, uint32_t id, uint32_t bits) {
    if (appearance->specialisation_count == FILTER_MAXIMUM_SPECIALISATIONS) {
        lobe_graph_fail(appearance->graph, LOBE_ERROR_LIMIT,
                        "the filter sets specialisation constant %u after %d others, which is the "
                        "most",
                        id, FILTER_MAXIMUM_SPECIALISATIONS);
        return;
    }
    appearance->specialisation[appearance->specialisation_count++] =
        (lobe_specialisation){id, bits};
}

void passes_appearance_specialise_number(filtered_appearance *appearance, uint32_t id,
                                         float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    passes_appearance_specialise(appearance, id, bits);
}
