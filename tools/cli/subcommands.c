#include "tools/cli/subcommand.h"

#include <stdio.h>
#include <string.h>

#include "tools/cli/closest_name.h"

const subcommand *const subcommands[] = {
    &render_subcommand,
    &view_subcommand,
    &bench_subcommand,
    &report_subcommand,
    &compare_subcommand,
    &environment_subcommand,
    &prepare_subcommand,
    &scenes_subcommand,
    &filters_subcommand,
    &info_subcommand,
    &manual_subcommand,
    &completion_subcommand,
    NULL,
};

const subcommand *subcommand_find(const char *name) {
    for (size_t index = 0; subcommands[index] != NULL; index++) {
        if (strcmp(subcommands[index]->name, name) == 0)
            return subcommands[index];
    }
    return NULL;
}

const char *subcommand_hint(const char *name, char *hint) {
    closest_name closest = {.name = name, .length = strlen(name)};
    for (size_t index = 0; subcommands[index] != NULL; index++)
        closest_name_offer(&closest, subcommands[index]->name);
    return closest_name_hint(&closest, "", hint);
}

int subcommand_print(const subcommand *subcommand, const char *form) {
    char name[32], option[32];
    snprintf(name, sizeof name, "%s", subcommand->name);
    snprintf(option, sizeof option, "--help=%s", form);
    return subcommand->run(2, (char *[]){name, option, NULL});
}
