// Completion for bash.

#include "tools/cli/subcommand.h"
#include "tools/manual/completion.h"
#include "tools/manual/option_form.h"
#include "tools/scenes/scene_list.h"

static void print_knob(FILE *stream, const lobe_knob *knob) {
    fprintf(stream, " %s", knob->name);
}

static void print_choices(FILE *stream, const lobe_knob *knob) {
    for (size_t index = 0; knob->kind == LOBE_KNOB_CHOICE && knob->choices[index]; index++)
        fprintf(stream, " %s=%s", knob->name, knob->choices[index]);
}

static void begin(FILE *stream) {
    fputs("# Completion of lobe for bash, as 'lobe completion bash' prints it.\n\n", stream);
    fputs("_lobe_subcommands='", stream);
    for (size_t index = 0; subcommands[index]; index++)
        fprintf(stream, " %s", subcommands[index]->name);
    fputs("'\n_lobe_scenes='", stream);
    for (size_t index = 0; index < scene_list_count(); index++)
        fprintf(stream, " %s", scene_list_get(index).name);
    fputs("'\n_lobe_filters='", stream);
    for (size_t index = 0; index < lobe_filter_count(); index++)
        fprintf(stream, " %s", lobe_filter_name(lobe_filter_get(index)));
    fputs("'\n_lobe_knobs='", stream);
    completion_visit_knobs(print_knob, stream);
    fputs("'\n_lobe_choices='", stream);
    completion_visit_knobs(print_choices, stream);
    fputs("'\n\n# $1: subcommand, $2: option. Sets what may follow.\n"
          "_lobe_table() {\n    case $1 in\n",
          stream);
}

/// The script's name for a kind of values.
static const char *value_name(option_values values) {
    static const char *const names[] = {
        [OPTION_VALUES_PLAIN] = "none",    [OPTION_VALUES_NONE] = "none",
        [OPTION_VALUES_CHOICE] = "words",  [OPTION_VALUES_FILE] = "file",
        [OPTION_VALUES_FOLDER] = "folder", [OPTION_VALUES_SCENE] = "scene",
        [OPTION_VALUES_FILTER] = "filter", [OPTION_VALUES_FILTER_LIST] = "filters",
        [OPTION_VALUES_KNOB] = "knob",     [OPTION_VALUES_SUBCOMMAND] = "subcommand",
    };
    return names[values];
}

static void print_names(FILE *stream, const option *option, const char *between) {
    if (option->letter != '\0')
        fprintf(stream, "-%c%s", option->letter, between);
    fprintf(stream, "--%s", option->name);
}

/// The values that may follow an option.
static void print_value(FILE *stream, const option *option) {
    fputs("        ", stream);
    print_names(stream, option, "|");
    fprintf(stream, ") value=%s", value_name(option_form_values(option)));
    if (option->kind == OPTION_CHOICE) {
        fputs(" words='", stream);
        for (size_t index = 0; option->choices[index]; index++)
            fprintf(stream, "%s%s", index > 0 ? " " : "", option->choices[index]);
        fputc('\'', stream);
    }
    fputs(" ;;\n", stream);
}

void completion_bash_print(const option_table *table, FILE *stream) {
    fprintf(stream, "    %s)\n        options='", option_form_subcommand(table));
    for (size_t index = 0; index < table->option_count; index++) {
        print_names(stream, &table->options[index], " ");
        fputc(' ', stream);
    }
    fprintf(stream, "--help' operand=%s value=\n        case $2 in\n",
            value_name(table->operand_values));
    for (size_t index = 0; index < table->option_count; index++) {
        if (table->options[index].kind != OPTION_FLAG)
            print_value(stream, &table->options[index]);
    }
    fputs("        esac ;;\n", stream);
}

static void end(FILE *stream) {
    fputs("    esac\n"
          "}\n"
          "\n"
          "# $1: kind of values, $2: what is typed of one\n"
          "_lobe_offer() {\n"
          "    case $1 in\n"
          "    words) COMPREPLY=($(compgen -W \"$words\" -- \"$2\")) ;;\n"
          "    scene) COMPREPLY=($(compgen -W \"$_lobe_scenes\" -- \"$2\")) ;&\n"
          "    file) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- \"$2\")\n"
          "        compopt -o filenames 2>/dev/null ;;\n"
          "    folder) mapfile -t COMPREPLY < <(compgen -d -- \"$2\")\n"
          "        compopt -o filenames 2>/dev/null ;;\n"
          "    filter) COMPREPLY=($(compgen -W \"$_lobe_filters\" -- \"$2\")) ;;\n"
          "    filters) local before=\n"
          "        [[ $2 == *,* ]] && before=${2%,*},\n"
          "        COMPREPLY=($(compgen -P \"$before\" -W \"$_lobe_filters\" -- \"${2##*,}\"))\n"
          "        compopt -o nospace 2>/dev/null ;;\n"
          "    knob) if [[ $2 == *=* ]]; then\n"
          "            COMPREPLY=($(compgen -W \"$_lobe_choices\" -- \"$2\"))\n"
          "        else\n"
          "            COMPREPLY=($(compgen -S = -W \"$_lobe_knobs\" -- \"$2\"))\n"
          "            compopt -o nospace 2>/dev/null\n"
          "        fi ;;\n"
          "    subcommand) COMPREPLY=($(compgen -W \"$_lobe_subcommands\" -- \"$2\")) ;;\n"
          "    esac\n"
          "}\n"
          "\n"
          "# Bash has split the line at \"=\" and \":\" too: here a word ends where a blank is, "
          "and of what is\n"
          "# offered only the part behind the last of them is to be put in.\n"
          "_lobe() {\n"
          "    local -a typed\n"
          "    local options= words= value= operand= current\n"
          "    read -a typed <<< \"${COMP_LINE:0:COMP_POINT}.\"\n"
          "    current=${typed[-1]%.}\n"
          "    COMPREPLY=()\n"
          "    if ((${#typed[@]} <= 2)); then\n"
          "        COMPREPLY=($(compgen -W \"$_lobe_subcommands help --help --version\" -- "
          "\"$current\"))\n"
          "        return\n"
          "    elif [[ ${typed[1]} == help ]]; then\n"
          "        _lobe_offer subcommand \"$current\"\n"
          "        return\n"
          "    fi\n"
          "    _lobe_table \"${typed[1]}\" \"${typed[-2]}\"\n"
          "    if [[ $value ]]; then\n"
          "        _lobe_offer \"$value\" \"$current\"\n"
          "    elif [[ $current == --*=* ]]; then\n"
          "        _lobe_table \"${typed[1]}\" \"${current%%=*}\"\n"
          "        _lobe_offer \"$value\" \"${current#*=}\"\n"
          "        current=${current#*=}\n"
          "    elif [[ $current == -* ]]; then\n"
          "        COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
          "    else\n"
          "        _lobe_offer \"$operand\" \"$current\"\n"
          "    fi\n"
          "    local split=${current%\"${current##*[=:]}\"}\n"
          "    [[ $split ]] && COMPREPLY=(\"${COMPREPLY[@]#\"$split\"}\")\n"
          "}\n"
          "\n"
          "complete -F _lobe lobe\n",
          stream);
}

const completion_shell completion_bash = {"bash", begin, end};
