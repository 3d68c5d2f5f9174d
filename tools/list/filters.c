#include <stdio.h>

#include <lobe/filter.h>

#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"
#include "tools/manual/roff.h"

/// "0.85  [0, 1]", or "auto  {auto, tangent, object, camera}"
static void describe_values(const lobe_filter *filter, size_t index, char *text, size_t size) {
    const lobe_knob *knob = lobe_filter_knob(filter, index);
    lobe_settings settings;
    char initial[64];
    lobe_settings_default(filter, &settings);
    lobe_settings_print(filter, &settings, index, initial, sizeof initial);
    size_t used = (size_t)snprintf(text, size, "%s  ", initial);
    if (knob->kind != LOBE_KNOB_CHOICE) {
        snprintf(text + used, size - used, "[%g, %g]%s", knob->minimum, knob->maximum,
                 knob->kind == LOBE_KNOB_INTEGER ? " whole" : "");
        return;
    }
    for (size_t i = 0; knob->choices[i] && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i == 0 ? "{" : ", ",
                                 knob->choices[i]);
    if (used < size)
        snprintf(text + used, size - used, "}");
}

static void print_filter(const lobe_filter *filter) {
    printf("%s: %s\n", lobe_filter_name(filter), lobe_filter_summary(filter));
    if (lobe_filter_paper(filter)[0] != '\0')
        printf("    from %s\n", lobe_filter_paper(filter));
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        char values[256];
        describe_values(filter, i, values, sizeof values);
        printf("    %-12s %s\n", lobe_filter_knob(filter, i)->name, values);
        printf("    %-12s %s\n", "", lobe_filter_knob(filter, i)->summary);
    }
}

static void print_manual_of_filter(FILE *stream, const lobe_filter *filter) {
    fputs(".SS ", stream);
    roff_text(stream, lobe_filter_name(filter));
    fputc('\n', stream);
    roff_text(stream, lobe_filter_summary(filter));
    if (lobe_filter_paper(filter)[0] != '\0') {
        fputs(" (", stream);
        roff_text(stream, lobe_filter_paper(filter));
        fputc(')', stream);
    }
    fputc('\n', stream);
    for (size_t i = 0; i < lobe_filter_knob_count(filter); i++) {
        const lobe_knob *knob = lobe_filter_knob(filter, i);
        char values[256];
        describe_values(filter, i, values, sizeof values);
        roff_item(stream, knob->name, values, knob->summary);
    }
}

static void print_manual(FILE *stream) {
    roff_section(stream, "FILTERS");
    for (size_t i = 0; i < lobe_filter_count(); i++)
        print_manual_of_filter(stream, lobe_filter_get(i));
}

static int run(int argc, char **argv) {
    const option_table table = {
        .program = "lobe filters",
        .summary = "Lists the filters with their knobs: name, default, range or choices, meaning.\n"
                   "Knobs are set by --set NAME=VALUE.",
        .manual = print_manual,
    };
    int status;
    if (!options_parse(&table, argc, argv, NULL, &status))
        return status;
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        if (i > 0)
            putchar('\n');
        print_filter(lobe_filter_get(i));
    }
    return 0;
}

const subcommand filters_subcommand = {"filters", "list the filters and their knobs", run};
