// Completion for zsh.

#include "tools/cli/subcommand.h"
#include "tools/manual/completion.h"
#include "tools/manual/option_form.h"
#include "tools/scenes/scene_list.h"

/// One word for _describe.
static void print_described(FILE *stream, const char *name, const char *summary) {
    fprintf(stream, "        '%s:", name);
    completion_quote(stream, summary, "");
    fputs("'\n", stream);
}

/// One specification for _values.
static void print_knob(FILE *stream, const lobe_knob *knob) {
    fprintf(stream, " \\\n        '%s[", knob->name);
    completion_quote(stream, knob->summary, "[]:");
    fputs("]:value:", stream);
    if (knob->kind == LOBE_KNOB_CHOICE) {
        fputc('(', stream);
        for (size_t index = 0; knob->choices[index]; index++)
            fprintf(stream, "%s%s", index > 0 ? " " : "", knob->choices[index]);
        fputc(')', stream);
    }
    fputc('\'', stream);
}

static void print_filters(FILE *stream) {
    fputs("_lobe_filters() {\n    local -a filters=(\n", stream);
    for (size_t index = 0; index < lobe_filter_count(); index++)
        print_described(stream, lobe_filter_name(lobe_filter_get(index)),
                        lobe_filter_summary(lobe_filter_get(index)));
    fputs("    )\n    _describe filter filters\n}\n\n"
          "_lobe_filter_list() {\n    _values -s , filter",
          stream);
    for (size_t index = 0; index < lobe_filter_count(); index++)
        fprintf(stream, " %s", lobe_filter_name(lobe_filter_get(index)));
    fputs("\n}\n\n", stream);
}

static void print_scenes(FILE *stream) {
    fputs("_lobe_scenes() {\n    local -a scenes=(\n", stream);
    for (size_t index = 0; index < scene_list_count(); index++)
        print_described(stream, scene_list_get(index).name, scene_list_get(index).summary);
    fputs("    )\n    _describe scene scenes\n    _files\n}\n\n", stream);
}

static void print_subcommands(FILE *stream) {
    fputs("_lobe_subcommands() {\n    local -a names=(\n", stream);
    for (size_t index = 0; subcommands[index]; index++)
        print_described(stream, subcommands[index]->name, subcommands[index]->summary);
    fputs("        'help:list the options of a subcommand'\n"
          "    )\n    _describe subcommand names\n}\n\n",
          stream);
}

static void begin(FILE *stream) {
    fputs("#compdef lobe\n"
          "# Completion of lobe for zsh, as 'lobe completion zsh' prints it.\n\n",
          stream);
    print_filters(stream);
    print_scenes(stream);
    print_subcommands(stream);
    fputs("_lobe_knobs() {\n    _values knob", stream);
    completion_visit_knobs(print_knob, stream);
    fputs("\n}\n\n"
          "_lobe() {\n"
          "    if ((CURRENT == 2)); then\n"
          "        _lobe_subcommands\n"
          "        return\n"
          "    fi\n"
          "    shift words\n"
          "    ((CURRENT--))\n"
          "    case $words[1] in\n"
          "    help) _arguments '1:subcommand:_lobe_subcommands' ;;\n",
          stream);
}

/// The function that completes a kind of values; "" if there is none.
static const char *action(option_values values) {
    static const char *const names[] = {
        [OPTION_VALUES_PLAIN] = "",
        [OPTION_VALUES_NONE] = "",
        [OPTION_VALUES_CHOICE] = "",
        [OPTION_VALUES_FILE] = "_files",
        [OPTION_VALUES_FOLDER] = "_files -/",
        [OPTION_VALUES_SCENE] = "_lobe_scenes",
        [OPTION_VALUES_FILTER] = "_lobe_filters",
        [OPTION_VALUES_FILTER_LIST] = "_lobe_filter_list",
        [OPTION_VALUES_KNOB] = "_lobe_knobs",
        [OPTION_VALUES_SUBCOMMAND] = "_lobe_subcommands",
    };
    return names[values];
}

static void print_value(FILE *stream, const option *option) {
    fputc(':', stream);
    completion_quote(stream, option->argument, ":");
    fprintf(stream, ":%s", action(option_form_values(option)));
    if (option->kind == OPTION_CHOICE) {
        fputc('(', stream);
        for (size_t index = 0; option->choices[index]; index++)
            fprintf(stream, "%s%s", index > 0 ? " " : "", option->choices[index]);
        fputc(')', stream);
    }
}

/// A specification for _arguments: '(-o --output)'{-o+,--output=}'[summary]:FILE:_files'
static void print_option(FILE *stream, const option *option) {
    bool flag = option->kind == OPTION_FLAG;
    fputs(" \\\n        ", stream);
    if (option->kind == OPTION_LIST)
        fputs("'*'", stream);
    else if (option->letter != '\0')
        fprintf(stream, "'(-%c --%s)'", option->letter, option->name);
    if (option->letter != '\0')
        fprintf(stream, "{-%c%s,--%s%s}", option->letter, flag ? "" : "+", option->name,
                flag ? "" : "=");
    else
        fprintf(stream, "--%s%s", option->name, flag ? "" : "=");
    fputs("'[", stream);
    completion_quote(stream, option->summary, "[]:");
    fputc(']', stream);
    if (!flag)
        print_value(stream, option);
    fputc('\'', stream);
}

void completion_zsh_print(const option_table *table, FILE *stream) {
    fprintf(stream, "    %s)\n        _arguments", option_form_subcommand(table));
    for (size_t index = 0; index < table->option_count; index++)
        print_option(stream, &table->options[index]);
    print_option(stream, &option_help);
    if (action(table->operand_values)[0] != '\0')
        fprintf(stream, " \\\n        '*:operand:%s'", action(table->operand_values));
    fputs(" ;;\n", stream);
}

static void end(FILE *stream) {
    fputs("    *) return 1 ;;\n    esac\n}\n\n_lobe \"$@\"\n", stream);
}

const completion_shell completion_zsh = {"zsh", begin, end};
