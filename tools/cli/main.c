#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <lobe/lobe.h>

#include "tools/cli/closest_name.h"
#include "tools/cli/subcommand.h"
#include "tools/manual/option_form.h"

static void print_help(FILE *stream) {
    fputs("Usage: lobe SUBCOMMAND [OPTION]... [OPERAND]...\n\n"
          "Renders scenes whose appearance stays true at every distance: normal and BRDF maps\n"
          "are filtered into mixtures of lobes.\n\nSubcommands:\n",
          stream);
    for (size_t i = 0; subcommands[i]; i++)
        fprintf(stream, "  %-11s %s\n", subcommands[i]->name, subcommands[i]->summary);
    fputs("\n'lobe help SUBCOMMAND' or 'lobe SUBCOMMAND --help' explains one.\n"
          "'lobe --version' prints the version.\n"
          "Exit status: 0 done, 1 failed, 2 wrong usage.\n",
          stream);
}

static int usage_error(const char *what, const char *text, const char *hint) {
    fprintf(stderr, "lobe: %s '%s'%s (see 'lobe --help')\n", what, text, hint);
    return 2;
}

static int unknown_option(const char *text) {
    closest_name closest = {.name = text, .length = strlen(text)};
    char hint[CLOSEST_NAME_HINT_SIZE];
    closest_name_offer(&closest, "--help");
    closest_name_offer(&closest, "--version");
    return usage_error("unknown option", text, closest_name_hint(&closest, "", hint));
}

static int unknown_subcommand(const char *name) {
    char hint[CLOSEST_NAME_HINT_SIZE];
    return usage_error("unknown subcommand", name, subcommand_hint(name, hint));
}

/// `lobe help`, `lobe help SUBCOMMAND`
static int help(int argc, char **argv) {
    if (argc > 2)
        return usage_error("unexpected operand", argv[2], "");
    if (argc < 2) {
        print_help(stdout);
        return 0;
    }
    const subcommand *found = subcommand_find(argv[1]);
    if (!found)
        return unknown_subcommand(argv[1]);
    char option[] = "--help";
    return found->run(2, (char *[]){argv[1], option, NULL});
}

static int run(int argc, char **argv) {
    if (argc < 2) {
        print_help(stderr);
        return 2;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0)
        return help(argc - 1, argv + 1);
    if (strcmp(argv[1], "--version") == 0) {
        printf("lobe %s\n", lobe_version());
        return 0;
    }
    if (argv[1][0] == '-')
        return unknown_option(argv[1]);
    const subcommand *found = subcommand_find(argv[1]);
    return found ? found->run(argc - 1, argv + 1) : unknown_subcommand(argv[1]);
}

int main(int argc, char **argv) {
    options_set_form_finder(option_form_find);
    int status = run(argc, argv);
    // Output may still be lost, for example on a full disk.
    bool failed = fflush(stdout) != 0 || ferror(stdout);
    if (failed && status == 0) {
        fprintf(stderr, "lobe: error: standard output: %s\n", strerror(errno));
        return 1;
    }
    return status;
}
