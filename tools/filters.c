#include <stdio.h>

#include <lobe/filter.h>

#include "tools/options.h"
#include "tools/subcommand.h"

/// "0.85  [0, 1]", or "auto  {auto, tangent, object, camera}"
static void print_values(const lobe_filter *filter, size_t index) {
    const lobe_knob *knob = lobe_filter_knob(filter, index);
    lobe_settings settings;
    char initial[64];
    lobe_settings_default(filter, &settings);
    lobe_settings_print(filter, &settings, index, initial, sizeof initial);
    printf("    %-12s %s  ", knob->name, initial);
    if (knob->kind != LOBE_KNOB_CHOICE) {
        printf("[%g, %g]%s\n", knob->minimum, knob->maximum,
               knob->kind == LOBE_KNOB_INTEGER ? " whole" : "");
        return;
    }
    for (size_t i = 0; knob->choices[i]; ++i)
        printf("%s%s", i == 0 ? "{" : ", ", knob->choices[i]);
    puts("}");
}

static void print_filter(const lobe_filter *filter) {
    printf("%s: %s\n", lobe_filter_name(filter), lobe_filter_summary(filter));
    if (lobe_filter_paper(filter)[0] != '\0')
        printf("    from %s\n", lobe_filter_paper(filter));
    for (size_t i = 0; i < lobe_filter_knob_count(filter); ++i) {
        print_values(filter, i);
        printf("    %-12s %s\n", "", lobe_filter_knob(filter, i)->summary);
    }
}

static int run(int argc, char **argv) {
    const option_table table = {
        .program = "lobe filters",
        .summary = "Lists the filters with their knobs: name, default, range or choices, meaning.\n"
                   "Knobs are set by --set NAME=VALUE.",
    };
    int status;
    if (!options_parse(&table, argc, argv, NULL, &status))
        return status;
    for (size_t i = 0; i < lobe_filter_count(); ++i) {
        if (i > 0)
            putchar('\n');
        print_filter(lobe_filter_get(i));
    }
    return 0;
}

const subcommand filters_subcommand = {"filters", "list the filters and their knobs", run};
