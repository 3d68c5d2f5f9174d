#include "tools/manual/completion.h"

#include <stdbool.h>
#include <string.h>

#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"

static const completion_shell *const shells[] = {&completion_bash, &completion_zsh,
                                                 &completion_fish};
static const size_t shell_count = sizeof shells / sizeof *shells;

static const lobe_knob *find_knob(const lobe_filter *filter, const char *name) {
    for (size_t index = 0; index < lobe_filter_knob_count(filter); index++) {
        const lobe_knob *knob = lobe_filter_knob(filter, index);
        if (strcmp(knob->name, name) == 0)
            return knob;
    }
    return NULL;
}

static bool was_visited(size_t filter, const char *knob) {
    for (size_t earlier = 0; earlier < filter; earlier++) {
        if (find_knob(lobe_filter_get(earlier), knob))
            return true;
    }
    return false;
}

enum { MAXIMUM_CHOICES = 64 };

/// Adds choices that are not in the list yet; the list still ends with NULL.
static void add_choices(const char *list[MAXIMUM_CHOICES], const char *const *choices) {
    for (; choices && *choices; choices++) {
        size_t place = 0;
        while (list[place] && strcmp(list[place], *choices) != 0)
            place++;
        if (place + 1 < MAXIMUM_CHOICES)
            list[place] = *choices;
    }
}

/// Filters may have different choices for a knob.
static void visit_merged(void (*visit)(FILE *stream, const lobe_knob *knob), FILE *stream,
                         const lobe_knob *first) {
    const char *choices[MAXIMUM_CHOICES] = {NULL};
    lobe_knob merged = *first;
    for (size_t index = 0; index < lobe_filter_count(); index++) {
        const lobe_knob *knob = find_knob(lobe_filter_get(index), first->name);
        if (knob)
            add_choices(choices, knob->choices);
    }
    merged.choices = choices;
    visit(stream, &merged);
}

void completion_visit_knobs(void (*visit)(FILE *stream, const lobe_knob *knob), FILE *stream) {
    for (size_t filter = 0; filter < lobe_filter_count(); filter++) {
        size_t count = lobe_filter_knob_count(lobe_filter_get(filter));
        for (size_t index = 0; index < count; index++) {
            const lobe_knob *knob = lobe_filter_knob(lobe_filter_get(filter), index);
            if (!was_visited(filter, knob->name))
                visit_merged(visit, stream, knob);
        }
    }
}

void completion_quote(FILE *stream, const char *text, const char *special) {
    for (; *text != '\0'; text++) {
        if (*text == '\'') {
            fputs("'\\''", stream);
            continue;
        }
        if (*text == '\\' || strchr(special, *text) != NULL)
            fputc('\\', stream);
        fputc(*text, stream);
    }
}

static int print(const completion_shell *shell) {
    int status = 0;
    shell->begin(stdout);
    for (size_t index = 0; status == 0 && subcommands[index] != NULL; index++)
        status = subcommand_print(subcommands[index], shell->name);
    shell->end(stdout);
    return status;
}

static int print_by_name(const option_table *table, const char *name) {
    for (size_t index = 0; index < shell_count; index++) {
        if (strcmp(shells[index]->name, name) == 0)
            return print(shells[index]);
    }
    return options_usage_error(table, "unknown shell '%s', known are %s", name, table->operands);
}

static int run(int argc, char **argv) {
    const option_table table = {
        .program = "lobe completion",
        .operands = "bash|zsh|fish",
        .summary =
            "Prints a script with which the shell completes subcommands, options, filters, knobs\n"
            "and scenes. 'meson install' installs all three; without it:\n\n"
            "  source <(lobe completion bash)",
        .minimum_operands = 1,
        .maximum_operands = 1,
    };
    option_list operands = {0};
    int status;
    if (options_parse(&table, argc, argv, &operands, &status))
        status = print_by_name(&table, operands.values[0]);
    options_free(&table, &operands);
    return status;
}

const subcommand completion_subcommand = {"completion", "print a script for a shell's completion",
                                          run};
