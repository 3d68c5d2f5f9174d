#include "tools/manual/option_form.h"

#include <string.h>

option_form *option_form_find(const char *name) {
    static const struct {
        const char *name;
        option_form *form;
    } forms[] = {
        {"man", manual_page_print},
        {"bash", completion_bash_print},
        {"zsh", completion_zsh_print},
        {"fish", completion_fish_print},
    };
    for (size_t index = 0; index < sizeof forms / sizeof *forms; index++) {
        if (strcmp(forms[index].name, name) == 0)
            return forms[index].form;
    }
    return NULL;
}

option_values option_form_values(const option *option) {
    if (option->values != OPTION_VALUES_PLAIN)
        return option->values;
    if (option->kind == OPTION_CHOICE)
        return OPTION_VALUES_CHOICE;
    if (option->kind != OPTION_FLAG && strncmp(option->argument, "FILE", 4) == 0)
        return OPTION_VALUES_FILE;
    if (option->kind != OPTION_FLAG && strncmp(option->argument, "DIR", 3) == 0)
        return OPTION_VALUES_FOLDER;
    return OPTION_VALUES_NONE;
}

const char *option_form_subcommand(const option_table *table) {
    const char *space = strrchr(table->program, ' ');
    return space != NULL ? space + 1 : table->program;
}
