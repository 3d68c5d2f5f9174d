#include "passes/context/knob_values.h"

#include "passes/context/shared_knobs.h"
#include "shaders/interface/knobs.h"

static size_t own_knob_count(const lobe_filter *filter) {
    size_t count = 0;
    while (filter->knobs && filter->knobs[count])
        count++;
    return count;
}

static size_t shared_knob_count(void) {
    size_t count = 0;
    while (passes_shared_knobs[count])
        count++;
    return count;
}

/// The reference has its own default of one shared knob.
static const filter_knob *shared_knob(const lobe_filter *filter, size_t index) {
    const filter_knob *knob = passes_shared_knobs[index];
    return filter->supersamples && knob == &passes_knob_environment
               ? &passes_knob_reference_environment
               : knob;
}

size_t lobe_filter_knob_count(const lobe_filter *filter) {
    if (!filter)
        return 0;
    return own_knob_count(filter) + shared_knob_count();
}

const filter_knob *passes_filter_knob(const lobe_filter *filter, size_t index) {
    size_t own = own_knob_count(filter);
    if (index < own)
        return filter->knobs[index];
    return index - own < shared_knob_count() ? shared_knob(filter, index - own) : NULL;
}

const lobe_knob *lobe_filter_knob(const lobe_filter *filter, size_t index) {
    if (!filter)
        return NULL;
    const filter_knob *knob = passes_filter_knob(filter, index);
    return knob ? &knob->description : NULL;
}

// ---------------------------------------------------------------------------------------------
// Values

/// Finds the knob's index in the settings; false if the filter does not have it.
static bool find_value(const lobe_filter *filter, const filter_knob *knob, size_t *index) {
    size_t own = own_knob_count(filter);
    for (*index = 0; *index < own; (*index)++)
        if (filter->knobs[*index] == knob)
            return true;
    for (; passes_shared_knobs[*index - own]; (*index)++)
        if (passes_shared_knobs[*index - own] == knob)
            return true;
    return false;
}

double passes_knob_value(const filter_context *context, const filter_knob *knob) {
    size_t index;
    return find_value(context->filter, knob, &index) ? context->settings->values[index]
                                                     : knob->description.initial;
}

uint32_t passes_knob_choice(const filter_context *context, const filter_knob *knob) {
    return (uint32_t)passes_knob_value(context, knob);
}

bool passes_closes_surfaces(const filter_context *context) {
    return passes_knob_choice(context, &passes_knob_normal_mapping) > 0;
}

// ---------------------------------------------------------------------------------------------
// The shading pass

void passes_knob_specialise(const filter_context *context, const filter_knob *knob,
                            specialisation_list *list) {
    if (knob->feeds.route == KNOB_CONSTANT)
        passes_specialise(list, knob->feeds.place, passes_knob_choice(context, knob));
}

void passes_knobs_specialise(const filter_context *context, specialisation_list *list) {
    const filter_knob *knob;
    for (size_t i = 0; (knob = passes_filter_knob(context->filter, i)); i++) {
        const double value = context->settings->values[i];
        if (knob->feeds.route == KNOB_CONSTANT)
            passes_specialise(list, knob->feeds.place, (uint32_t)value);
        if (knob->compiles)
            passes_specialise(list, knob->compiles, value != 0);
    }
}

/// A block of floats as large as the shader's, whose size is a multiple of 16 bytes.
static void bind_numbers(const filter_context *context, knob_route route, size_t size,
                         const char *name, lobe_pass *pass) {
    float block[KNOB_BLOCK_SIZE / sizeof(float)] = {0};
    const filter_knob *knob;
    for (size_t i = 0; (knob = passes_filter_knob(context->filter, i)); i++) {
        if (knob->feeds.route != route)
            continue;
        block[knob->feeds.place / sizeof *block] = (float)context->settings->values[i];
        if (size <= knob->feeds.place)
            size = (knob->feeds.place / 16 + 1) * 16;
    }
    if (size > 0)
        lobe_pass_read(pass, &(lobe_binding){
                                 .name = name,
                                 .resource = lobe_graph_upload(context->graph, name, block, size)});
}

void passes_shared_knobs_bind(const filter_context *context, lobe_pass *pass) {
    bind_numbers(context, KNOB_SHARED_NUMBER, sizeof(struct shared_knobs), "knob_block", pass);
}

void passes_knobs_bind(const filter_context *context, lobe_pass *pass) {
    passes_shared_knobs_bind(context, pass);
    bind_numbers(context, KNOB_FILTER_NUMBER, 0, "filter_knob_block", pass);
}
