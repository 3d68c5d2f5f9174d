#include "passes/filters/settings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/context/filter.h"
#include "passes/context/knob_values.h"

void lobe_settings_default(const lobe_filter *filter, lobe_settings *settings) {
    if (!settings)
        return;
    *settings = (lobe_settings){{0}};
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++)
        settings->values[i] = lobe_filter_knob(filter, i)->initial;
}

/// Index of the knob whose name is the first `length` bytes of `name`; the knob count if there is
/// none.
static size_t find_knob(const lobe_filter *filter, const char *name, size_t length) {
    size_t count = lobe_filter_knob_count(filter);
    for (size_t i = 0; i < count; i++) {
        const char *candidate = lobe_filter_knob(filter, i)->name;
        if (strlen(candidate) == length && memcmp(candidate, name, length) == 0)
            return i;
    }
    return count;
}

static lobe_result no_such_knob(const lobe_filter *filter, const char *name, size_t length,
                                const lobe_host *host) {
    char names[512] = "";
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++)
        passes_append_name(names, sizeof names, lobe_filter_knob(filter, i)->name);
    lobe_host_log(host, LOBE_LOG_ERROR, "filter '%s' has no knob '%.*s'; it has %s", filter->name,
                  (int)length, name, names);
    return LOBE_ERROR_NOT_FOUND;
}

static lobe_result set_choice(const lobe_knob *knob, const char *text, double *value,
                              const lobe_host *host) {
    char choices[256] = "";
    for (size_t i = 0; knob->choices[i]; i++) {
        if (strcmp(knob->choices[i], text) == 0) {
            *value = (double)i;
            return LOBE_OK;
        }
        passes_append_name(choices, sizeof choices, knob->choices[i]);
    }
    lobe_host_log(host, LOBE_LOG_ERROR, "knob '%s' cannot be '%s'; it is one of %s", knob->name,
                  text, choices);
    return LOBE_ERROR_INVALID_ARGUMENT;
}

/// The value of a choice is its index.
static bool allows(const lobe_knob *knob, double value) {
    bool whole = knob->kind != LOBE_KNOB_NUMBER;
    return value >= knob->minimum && value <= knob->maximum && (!whole || value == floor(value));
}

static lobe_result refuse_number(const lobe_knob *knob, const char *text, const lobe_host *host) {
    bool whole = knob->kind != LOBE_KNOB_NUMBER;
    lobe_host_log(host, LOBE_LOG_ERROR, "knob '%s' cannot be '%s'; it is a %s from %g to %g",
                  knob->name, text, whole ? "whole number" : "number", knob->minimum,
                  knob->maximum);
    return LOBE_ERROR_INVALID_ARGUMENT;
}

static lobe_result set_number(const lobe_knob *knob, const char *text, double *value,
                              const lobe_host *host) {
    char *end = NULL;
    double number = strtod(text, &end);
    if (*text == '\0' || *end != '\0' || !allows(knob, number))
        return refuse_number(knob, text, host);
    *value = number;
    return LOBE_OK;
}

/// Checks every value against its knob.
static lobe_result check_values(const lobe_filter *filter, const lobe_settings *settings,
                                const lobe_host *host) {
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(filter, i);
        char text[32];
        snprintf(text, sizeof text, "%g", settings->values[i]);
        if (!allows(knob, settings->values[i]))
            return refuse_number(knob, text, host);
    }
    return LOBE_OK;
}

/// The feature of that name if the device lacks it; otherwise NULL. `name` may be NULL.
static const lobe_device_feature *find_missing(const lobe_device_information *device,
                                               const char *name) {
    for (size_t i = 0; name && i < device->feature_count; i++)
        if (!strcmp(device->features[i].name, name) && !device->features[i].present)
            return &device->features[i];
    return NULL;
}

/// Checks that the device has the features that knobs need which are not at their defaults.
static lobe_result check_device(const lobe_filter *filter, const lobe_settings *settings,
                                const lobe_device_information *device, const lobe_host *host) {
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        const filter_knob *knob = passes_filter_knob(filter, i);
        const lobe_device_feature *missing = find_missing(device, knob->needs);
        if (missing && settings->values[i] != knob->description.initial)
            return lobe_host_fail(host, LOBE_ERROR_UNSUPPORTED,
                                  "knob '%s' must be %g: the device '%s' lacks %s (%s)",
                                  knob->description.name, knob->description.initial, device->name,
                                  missing->name, missing->use);
    }
    return LOBE_OK;
}

lobe_result passes_settings_choose(const lobe_filter *wanted, const lobe_settings *given,
                                   const lobe_device_information *device, const lobe_host *host,
                                   const lobe_filter **filter, lobe_settings *settings) {
    lobe_result result = LOBE_OK;
    *filter = wanted;
    if (!wanted)
        result = lobe_filter_find("moments", host, filter);
    if (result != LOBE_OK)
        return result;
    lobe_settings_default(*filter, settings);
    if (given)
        *settings = *given;
    result = check_values(*filter, settings, host);
    return result ? result : check_device(*filter, settings, device, host);
}

lobe_result lobe_settings_set(const lobe_filter *filter, lobe_settings *settings,
                              const char *assignment, const lobe_host *host) {
    if (!filter || !settings || !assignment)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_settings_set: filter, settings and assignment must not be NULL");
    const char *equals = strchr(assignment, '=');
    if (!equals) {
        lobe_host_log(host, LOBE_LOG_ERROR, "'%s' sets no knob; write NAME=VALUE", assignment);
        return LOBE_ERROR_INVALID_ARGUMENT;
    }
    size_t length = (size_t)(equals - assignment);
    size_t index = find_knob(filter, assignment, length);
    const lobe_knob *knob = lobe_filter_knob(filter, index);
    if (!knob)
        return no_such_knob(filter, assignment, length, host);
    double *value = &settings->values[index];
    return knob->kind == LOBE_KNOB_CHOICE ? set_choice(knob, equals + 1, value, host)
                                          : set_number(knob, equals + 1, value, host);
}

lobe_result lobe_settings_get(const lobe_filter *filter, const lobe_settings *settings,
                              const char *name, double *value, const lobe_host *host) {
    if (!filter || !settings || !name || !value)
        return lobe_host_fail(
            host, LOBE_ERROR_INVALID_ARGUMENT,
            "lobe_settings_get: filter, settings, name and value must not be NULL");
    size_t length = strlen(name);
    size_t index = find_knob(filter, name, length);
    if (index == lobe_filter_knob_count(filter))
        return no_such_knob(filter, name, length, host);
    *value = settings->values[index];
    return LOBE_OK;
}

void lobe_settings_print(const lobe_filter *filter, const lobe_settings *settings, size_t knob,
                         char *text, size_t size) {
    const lobe_knob *description = lobe_filter_knob(filter, knob);
    if (!text || size == 0)
        return;
    text[0] = '\0';
    if (!description || !settings)
        return;
    double value = settings->values[knob];
    if (description->kind == LOBE_KNOB_CHOICE && allows(description, value))
        snprintf(text, size, "%s", description->choices[(size_t)value]);
    else
        snprintf(text, size, "%g", value);
}
