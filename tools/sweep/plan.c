#include "tools/sweep/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static lobe_result add(sweep_plan *plan, const bench_filter *filter, const char *varied,
                       const lobe_host *host) {
    sweep_variant *grown = realloc(plan->variants, (plan->count + 1) * sizeof *grown);
    if (!grown)
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "sweep: out of memory");
    plan->variants = grown;
    grown[plan->count++] = (sweep_variant){*filter, varied};
    return LOBE_OK;
}

static lobe_result add_value(sweep_plan *plan, const bench_filter *filter, size_t knob,
                             const char *value, int length, const lobe_host *host) {
    bench_filter changed = *filter;
    const lobe_knob *description = lobe_filter_knob(filter->filter, knob);
    char assignment[128];
    snprintf(assignment, sizeof assignment, "%s=%.*s", description->name, length, value);
    lobe_result result = lobe_settings_set(filter->filter, &changed.settings, assignment, host);
    if (result != LOBE_OK || changed.settings.values[knob] == filter->settings.values[knob])
        return result;
    if (description->sweep_with)
        result =
            lobe_settings_set(filter->filter, &changed.settings, description->sweep_with, host);
    return result == LOBE_OK ? add(plan, &changed, description->name, host) : result;
}

static lobe_result add_values(sweep_plan *plan, const bench_filter *filter, size_t knob,
                              const lobe_host *host) {
    lobe_result result = LOBE_OK;
    const char *rest = lobe_filter_knob(filter->filter, knob)->sweep;
    while (rest && result == LOBE_OK) {
        size_t length = strcspn(rest, ",");
        result = add_value(plan, filter, knob, rest, (int)length, host);
        rest = rest[length] == ',' ? rest + length + 1 : NULL;
    }
    return result;
}

static bool has_filter(const sweep_plan *plan, const lobe_filter *filter) {
    for (size_t i = 0; i < plan->count; i++) {
        if (plan->variants[i].filter.filter == filter)
            return true;
    }
    return false;
}

bool sweep_plan_lists(const char *knobs, const char *knob) {
    const size_t length = strlen(knob);
    for (const char *rest = knobs; rest; rest = strchr(rest, ',') ? strchr(rest, ',') + 1 : NULL) {
        if (strncmp(rest, knob, length) == 0 && (rest[length] == ',' || rest[length] == '\0'))
            return true;
    }
    return !knobs;
}

static bool goes_through(const sweep_plan_request *request, const lobe_knob *knob) {
    return (request->environment || !knob->environment) &&
           sweep_plan_lists(request->knobs, knob->name);
}

static lobe_result add_filter(const sweep_plan_request *request, const bench_filter *filter,
                              const lobe_host *host, sweep_plan *plan) {
    lobe_result result = add(plan, filter, "", host);
    size_t knobs =
        lobe_filter_supersamples(filter->filter) ? 0 : lobe_filter_knob_count(filter->filter);
    for (size_t i = 0; result == LOBE_OK && i < knobs; i++) {
        if (goes_through(request, lobe_filter_knob(filter->filter, i)))
            result = add_values(plan, filter, i, host);
    }
    return result;
}

lobe_result sweep_plan_make(const sweep_plan_request *request, const lobe_host *host,
                            sweep_plan *plan) {
    *plan = (sweep_plan){0};
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < request->filter_count; i++) {
        if (!has_filter(plan, request->filters[i].filter))
            result = add_filter(request, &request->filters[i], host, plan);
    }
    return result;
}

void sweep_plan_free(sweep_plan *plan) {
    free(plan->variants);
    *plan = (sweep_plan){0};
}

size_t sweep_variant_settings(const sweep_variant *variant, sweep_setting *settings) {
    const bench_filter *filter = &variant->filter;
    size_t count = lobe_filter_knob_count(filter->filter);
    for (size_t i = 0; i < count; i++) {
        snprintf(settings[i].name, sizeof settings[i].name, "%s",
                 lobe_filter_knob(filter->filter, i)->name);
        lobe_settings_print(filter->filter, &filter->settings, i, settings[i].value,
                            sizeof settings[i].value);
    }
    return count;
}
