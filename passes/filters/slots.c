#include "passes/filters/slots.h"

typedef struct filter_slot {
    void *prepared;
    uint32_t version; ///< of the material that it was prepared for, as version_of has it
} filter_slot;

struct filter_slots {
    filter_slots *next;
    const lobe_filter *filter;
    lobe_settings settings; ///< for which they are: only knobs that decide slots count
    size_t count;           ///< one for each material of the scene
    filter_slot slots[];
};

/// The version of a material that what the filter keeps is valid for.
static uint32_t version_of(const lobe_filter *filter, const device_scene *scene, size_t index) {
    const device_material *material = &scene->materials[index];
    if (filter->adapts_to_factors)
        return material->parameter_version;
    return filter->adapts_to_texels || scene->keeps_conclusions
               ? material->parameter_version + material->factor_version
               : material->version;
}

static void forget(const lobe_filter *filter, filter_slot *slot) {
    if (slot->prepared)
        filter->forget(slot->prepared);
    *slot = (filter_slot){0};
}

static bool are_for(const filter_slots *slots, const filter_context *context) {
    bool same = slots->filter == context->filter;
    for (size_t i = 0; same && slots->filter->knobs && slots->filter->knobs[i]; i++)
        same = !slots->filter->knobs[i]->decides_slots ||
               slots->settings.values[i] == context->settings->values[i];
    return same;
}

/// The slots of the context's filter and settings, added if missing. NULL: out of memory.
static filter_slots *slots_of(filter_slots **first, const filter_context *context) {
    for (filter_slots *slots = *first; slots; slots = slots->next)
        if (are_for(slots, context))
            return slots;
    const size_t count = context->scene->scene->material_count;
    filter_slots *added = lobe_allocate(lobe_host_allocator(context->host), 1,
                                        sizeof *added + count * sizeof *added->slots);
    if (!added)
        return NULL;
    added->next = *first;
    added->filter = context->filter;
    added->settings = *context->settings;
    added->count = count;
    *first = added;
    return added;
}

/// Lets the context's filter prepare a material, and returns what it keeps for it; NULL: nothing.
static lobe_result prepare(filter_slots **slots, const filter_context *context, uint32_t material,
                           const void **prepared) {
    *prepared = NULL;
    if (!context->filter->prepare)
        return LOBE_OK;
    filter_slots *own = slots_of(slots, context);
    if (!own)
        return LOBE_ERROR_OUT_OF_MEMORY;
    filter_slot *slot = &own->slots[material];
    slot->version = version_of(context->filter, context->scene, material);
    lobe_result result = context->filter->prepare(context, material, &slot->prepared);
    *prepared = slot->prepared;
    return result;
}

void passes_filter_slots_build(filter_slots **slots, const filter_context *context, size_t instance,
                               filtered_appearance *appearance) {
    const uint32_t material = context->scene->instances[instance].material;
    const void *prepared;
    *appearance = (filtered_appearance){.graph = context->graph};
    if (!context->filter->build)
        return;
    lobe_result result = prepare(slots, context, material, &prepared);
    if (result == LOBE_OK)
        context->filter->build(context, instance, prepared, appearance);
    else
        lobe_graph_fail(context->graph, result, "filter '%s', material '%s': %s",
                        context->filter->name, context->scene->scene->materials[material].name,
                        lobe_result_message(result));
}

void passes_filter_slots_save(filter_slots *slots, const lobe_graph *graph, const char *folder,
                              const lobe_host *host) {
    for (; slots; slots = slots->next)
        for (size_t i = 0; slots->filter->save && i < slots->count; i++)
            if (slots->slots[i].prepared)
                slots->filter->save(slots->slots[i].prepared, graph, folder, host);
}

void passes_filter_slots_update(filter_slots *slots, const device_scene *scene) {
    for (; slots; slots = slots->next)
        for (size_t i = 0; i < slots->count; i++)
            if (slots->slots[i].version != version_of(slots->filter, scene, i))
                forget(slots->filter, &slots->slots[i]);
}

void passes_filter_slots_destroy(filter_slots **slots) {
    while (*slots) {
        filter_slots *first = *slots;
        *slots = first->next;
        for (size_t i = 0; i < first->count; i++)
            forget(first->filter, &first->slots[i]);
        lobe_release(first);
    }
}
