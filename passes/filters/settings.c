#include "passes/filters/settings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/filters/filter.h"

static const char *const views[] = {"radiance", "lobes", "level", NULL};
static const char *const bases[] = {"exact", "lobe", NULL};

static const char *const methods[] = {"exact", "mip", "prefiltered", "sampled", NULL};
static const char *const sizes[] = {"16", "32", "64", "128", "256", "512", "1024", "2048", NULL};
static const char *const level_blends[] = {"trilinear", "blended", NULL};
static const char *const horizons[] = {"ignored", "clipped", "faded", NULL};
static const char *const scatterings[] = {"single", "multiple", NULL};

static const char environment_summary[] =
    "how light from an environment is integrated: over all its texels; in one fetch of its MIP "
    "chain; in a few of levels filtered with lobes; or with a grid of samples";

// Knobs of every filter, after its own.
static const lobe_knob shared_knobs[] = {
    {
        .name = "view",
        .summary = "what the picture shows: radiance, lobes evaluated, or MIP level",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 2,
        .choices = views,
    },
    {
        .name = "base",
        .summary = "evaluate base lobes as they are, or turned into von Mises-Fisher lobes first",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 1,
        .choices = bases,
    },
    {
        .name = "env",
        .summary = environment_summary,
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 3,
        .initial = 2,
        .choices = methods,
        .sweep = "mip,sampled", // exact takes hours
        .environment = true,
    },
    {
        .name = "env_size",
        .summary = "texels along a face of the cube that the environment is brought to",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 7,
        .initial = 4,
        .choices = sizes,
        .environment = true,
    },
    {
        .name = "env_probes",
        .summary = "prefiltered: round lobes that a long one is made of at most",
        .kind = LOBE_KNOB_INTEGER,
        .minimum = 1,
        .maximum = 8,
        .initial = 2,
        .sweep = "1,4,8",
        .environment = true,
    },
    {
        .name = "env_levels",
        .summary = "prefiltered: lobes between levels are blends of two levels, or nearer to what "
                   "they are, of a level each of two cubes (but for GGX lobes)",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 1,
        .choices = level_blends,
        .sweep = "blended",
        .environment = true,
    },
    {
        .name = "env_grid",
        .summary = "sampled: samples along each side of the grid",
        .kind = LOBE_KNOB_INTEGER,
        .minimum = 2,
        .maximum = 8,
        .initial = 5,
        .sweep = "3,7",
        .sweep_with = "env=sampled",
        .environment = true,
    },
    {
        .name = "env_window",
        .summary = "how strongly the nine harmonics of diffuse light are kept from ringing; 0: not",
        .maximum = 0.95,
        .environment = true,
    },
    {
        .name = "horizon",
        .summary = "what lobes see of the environment below the surface: is seen, is cut off, or "
                   "fades what is seen above",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 2,
        .initial = 1,
        .choices = horizons,
        .sweep = "ignored,faded",
        .environment = true,
    },
    {
        .name = "scattering",
        .summary = "microfacets reflect light once, or lose none to what they reflect again",
        .kind = LOBE_KNOB_CHOICE,
        .maximum = 1,
        .choices = scatterings,
    },
};
static const size_t shared_knob_count = sizeof shared_knobs / sizeof *shared_knobs;

// The reference's own default is the truth: each of its samples takes a sample of the environment.
static const lobe_knob exact_environment_knob = {
    .name = "env",
    .summary = environment_summary,
    .kind = LOBE_KNOB_CHOICE,
    .maximum = 3,
    .choices = methods,
    .environment = true,
};

static const lobe_knob *shared_knob(const lobe_filter *filter, size_t index) {
    const lobe_knob *knob = &shared_knobs[index];
    return filter->supersamples && strcmp(knob->name, "env") == 0 ? &exact_environment_knob : knob;
}

size_t lobe_filter_count(void) {
    size_t count = 0;
    while (passes_filter_table[count])
        ++count;
    return count;
}

const lobe_filter *lobe_filter_get(size_t index) {
    return index < lobe_filter_count() ? passes_filter_table[index] : NULL;
}

static void append(char *text, size_t size, const char *separator, const char *word) {
    size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used ? separator : "", word);
}

lobe_result lobe_filter_find(const char *name, const lobe_host *host, const lobe_filter **filter) {
    char names[512] = "";
    for (size_t i = 0; passes_filter_table[i]; ++i) {
        if (strcmp(passes_filter_table[i]->name, name) == 0) {
            *filter = passes_filter_table[i];
            return LOBE_OK;
        }
        append(names, sizeof names, ", ", passes_filter_table[i]->name);
    }
    *filter = NULL;
    lobe_host_log(host, LOBE_LOG_ERROR, "no filter '%s'; there are %s", name, names);
    return LOBE_ERROR_NOT_FOUND;
}

const char *lobe_filter_name(const lobe_filter *filter) {
    return filter->name;
}

const char *lobe_filter_summary(const lobe_filter *filter) {
    return filter->summary;
}

const char *lobe_filter_paper(const lobe_filter *filter) {
    return filter->paper;
}

bool lobe_filter_supersamples(const lobe_filter *filter) {
    return filter->supersamples;
}

static size_t own_knob_count(const lobe_filter *filter) {
    size_t count = 0;
    while (filter->knobs && filter->knobs[count])
        ++count;
    return count;
}

size_t lobe_filter_knob_count(const lobe_filter *filter) {
    return own_knob_count(filter) + shared_knob_count;
}

const lobe_knob *lobe_filter_knob(const lobe_filter *filter, size_t index) {
    size_t own = own_knob_count(filter);
    if (index < own)
        return filter->knobs[index];
    return index - own < shared_knob_count ? shared_knob(filter, index - own) : NULL;
}

void lobe_settings_default(const lobe_filter *filter, lobe_settings *settings) {
    *settings = (lobe_settings){{0}};
    for (size_t i = 0; i < lobe_filter_knob_count(filter); ++i)
        settings->values[i] = lobe_filter_knob(filter, i)->initial;
}

/// Index of the knob whose name is the first `length` bytes of `name`; the count where none is.
static size_t find_knob(const lobe_filter *filter, const char *name, size_t length) {
    size_t count = lobe_filter_knob_count(filter);
    for (size_t i = 0; i < count; ++i) {
        const char *candidate = lobe_filter_knob(filter, i)->name;
        if (strlen(candidate) == length && memcmp(candidate, name, length) == 0)
            return i;
    }
    return count;
}

static lobe_result no_such_knob(const lobe_filter *filter, const char *assignment, size_t length,
                                const lobe_host *host) {
    char names[512] = "";
    for (size_t i = 0; i < lobe_filter_knob_count(filter); ++i)
        append(names, sizeof names, ", ", lobe_filter_knob(filter, i)->name);
    lobe_host_log(host, LOBE_LOG_ERROR, "filter '%s' has no knob '%.*s'; it has %s", filter->name,
                  (int)length, assignment, names);
    return LOBE_ERROR_NOT_FOUND;
}

static lobe_result set_choice(const lobe_knob *knob, const char *text, double *value,
                              const lobe_host *host) {
    char choices[256] = "";
    for (size_t i = 0; knob->choices[i]; ++i) {
        if (strcmp(knob->choices[i], text) == 0) {
            *value = (double)i;
            return LOBE_OK;
        }
        append(choices, sizeof choices, ", ", knob->choices[i]);
    }
    lobe_host_log(host, LOBE_LOG_ERROR, "knob '%s' cannot be '%s'; it is one of %s", knob->name,
                  text, choices);
    return LOBE_ERROR_INVALID_ARGUMENT;
}

/// Choices are told by their index.
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

lobe_result passes_settings_check(const lobe_filter *filter, const lobe_settings *settings,
                                  const lobe_host *host) {
    for (size_t i = 0; i < lobe_filter_knob_count(filter); ++i) {
        const lobe_knob *knob = lobe_filter_knob(filter, i);
        char text[32];
        snprintf(text, sizeof text, "%g", settings->values[i]);
        if (!allows(knob, settings->values[i]))
            return refuse_number(knob, text, host);
    }
    return LOBE_OK;
}

lobe_result lobe_settings_set(const lobe_filter *filter, lobe_settings *settings,
                              const char *assignment, const lobe_host *host) {
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

double lobe_settings_get(const lobe_filter *filter, const lobe_settings *settings,
                         const char *name) {
    size_t index = find_knob(filter, name, strlen(name));
    return index < lobe_filter_knob_count(filter) ? settings->values[index] : 0;
}

void lobe_settings_print(const lobe_filter *filter, const lobe_settings *settings, size_t knob,
                         char *text, size_t size) {
    const lobe_knob *description = lobe_filter_knob(filter, knob);
    double value = settings->values[knob];
    if (description->kind == LOBE_KNOB_CHOICE)
        snprintf(text, size, "%s", description->choices[(size_t)value]);
    else
        snprintf(text, size, "%g", value);
}
