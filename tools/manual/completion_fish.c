// Completion for fish.

#include "tools/cli/subcommand.h"
#include "tools/manual/completion.h"
#include "tools/manual/option_form.h"
#include "tools/scenes/scene_list.h"

/// One candidate and its description, in the form that fish reads from a function's output.
static void print_candidate(FILE *stream, const char *name, const char *meaning) {
    fprintf(stream, "    echo %s\\t'", name);
    completion_quote(stream, meaning, "");
    fputs("'\n", stream);
}

static void print_knob(FILE *stream, const lobe_knob *knob) {
    char assignment[96];
    snprintf(assignment, sizeof assignment, "%s=", knob->name);
    if (knob->kind != LOBE_KNOB_CHOICE)
        print_candidate(stream, assignment, knob->summary);
    for (size_t index = 0; knob->kind == LOBE_KNOB_CHOICE && knob->choices[index]; index++) {
        snprintf(assignment, sizeof assignment, "%s=%s", knob->name, knob->choices[index]);
        print_candidate(stream, assignment, knob->summary);
    }
}

static void print_subcommands(FILE *stream) {
    fputs("function __lobe_subcommands\n", stream);
    for (size_t index = 0; subcommands[index]; index++)
        print_candidate(stream, subcommands[index]->name, subcommands[index]->summary);
    fputs("end\n", stream);
}

static void begin(FILE *stream) {
    fputs("# Completion of lobe for fish, as 'lobe completion fish' prints it.\n"
          "function __lobe_scenes\n",
          stream);
    for (size_t index = 0; index < scene_list_count(); index++)
        print_candidate(stream, scene_list_get(index).name, scene_list_get(index).summary);
    fputs("end\nfunction __lobe_filters\n", stream);
    for (size_t index = 0; index < lobe_filter_count(); index++)
        print_candidate(stream, lobe_filter_name(lobe_filter_get(index)),
                        lobe_filter_summary(lobe_filter_get(index)));
    fputs("end\nfunction __lobe_knobs\n", stream);
    completion_visit_knobs(print_knob, stream);
    fputs("end\n", stream);
    print_subcommands(stream);
    fputs("complete -c lobe -f\n"
          "complete -c lobe -n __fish_use_subcommand -a '(__lobe_subcommands)'\n"
          "complete -c lobe -n __fish_use_subcommand -a help -d 'list the options of a "
          "subcommand'\n"
          "complete -c lobe -n __fish_use_subcommand -l help\n"
          "complete -c lobe -n __fish_use_subcommand -l version\n"
          "complete -c lobe -n '__fish_seen_subcommand_from help' -a '(__lobe_subcommands)'\n",
          stream);
}

/// The arguments of fish's `complete` for a kind of values.
static const char *action(option_values values) {
    static const char *const words[] = {
        [OPTION_VALUES_PLAIN] = "-f",
        [OPTION_VALUES_NONE] = "-f",
        [OPTION_VALUES_CHOICE] = "-f",
        [OPTION_VALUES_FILE] = "-F",
        [OPTION_VALUES_FOLDER] = "-f -a '(__fish_complete_directories)'",
        [OPTION_VALUES_SCENE] = "-F -a '(__lobe_scenes)'",
        [OPTION_VALUES_FILTER] = "-f -a '(__lobe_filters)'",
        [OPTION_VALUES_FILTER_LIST] = "-f -a '(__fish_append , (__lobe_filters))'",
        [OPTION_VALUES_KNOB] = "-f -a '(__lobe_knobs)'",
        [OPTION_VALUES_SUBCOMMAND] = "-f -a '(__lobe_subcommands)'",
    };
    return words[values];
}

static void print_start(FILE *stream, const option_table *table) {
    fprintf(stream, "complete -c lobe -n '__fish_seen_subcommand_from %s'",
            option_form_subcommand(table));
}

static void print_option(FILE *stream, const option_table *table, const option *option) {
    print_start(stream, table);
    fprintf(stream, " -l %s", option->name);
    if (option->letter != '\0')
        fprintf(stream, " -s %c", option->letter);
    if (option->kind != OPTION_FLAG)
        fprintf(stream, " -r %s", action(option_form_values(option)));
    if (option->kind == OPTION_CHOICE) {
        fputs(" -a '", stream);
        for (size_t index = 0; option->choices[index]; index++)
            fprintf(stream, "%s%s", index > 0 ? " " : "", option->choices[index]);
        fputc('\'', stream);
    }
    fputs(" -d '", stream);
    completion_quote(stream, option->summary, "");
    fputs("'\n", stream);
}

void completion_fish_print(const option_table *table, FILE *stream) {
    for (size_t index = 0; index < table->option_count; index++)
        print_option(stream, table, &table->options[index]);
    print_option(stream, table, &option_help);
    print_start(stream, table);
    fprintf(stream, " %s\n", action(table->operand_values));
}

static void end(FILE *stream) {
    (void)stream;
}

const completion_shell completion_fish = {"fish", begin, end};
