#include <stdio.h>

#include "tools/cli/closest_name.h"
#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"
#include "tools/manual/roff.h"

static void print_subcommands(void) {
    roff_section(stdout, "SUBCOMMANDS");
    for (size_t index = 0; subcommands[index] != NULL; index++) {
        printf(".TP\n.BR lobe\\-%s (1)\n", subcommands[index]->name);
        roff_text(stdout, subcommands[index]->summary);
        putchar('\n');
    }
    roff_item(stdout, "lobe help", "SUBCOMMAND", "lists a subcommand's options.");
    roff_item(stdout, "lobe --version", NULL, "prints the version.");
}

static void print_environment(void) {
    roff_section(stdout, "ENVIRONMENT");
    roff_item(stdout, "LOBE_DEVICE", NULL, "the Vulkan device, as with --device.");
    roff_item(stdout, "LOBE_ASSETS", NULL, "the folder of assets, as with --assets.");
    roff_section(stdout, "FILES");
    roff_item(stdout, "$XDG_CACHE_HOME/lobe/, ~/.cache/lobe/", NULL, "compiled pipelines.");
}

/// The page of the program as a whole.
static void print_program(void) {
    roff_title(stdout, "lobe");
    roff_section(stdout, "NAME");
    puts("lobe \\- render scenes whose appearance stays true at every distance");
    roff_section(stdout, "SYNOPSIS");
    puts("\\fBlobe\\fR \\fISUBCOMMAND\\fR [\\fIOPTION\\fR]... [\\fIOPERAND\\fR]...");
    roff_section(stdout, "DESCRIPTION");
    roff_paragraphs(stdout, "Renders scenes with Vulkan. Normal and BRDF maps are filtered into\n"
                            "mixtures of lobes, so that a surface looks right at every distance;\n"
                            "other ways of filtering are included for comparison.");
    print_subcommands();
    print_environment();
    roff_section(stdout, "EXIT STATUS");
    puts("0 done, 1 failed (a line on standard error says why), 2 wrong usage.");
}

static int print(const option_table *table, const char *name) {
    if (name == NULL) {
        print_program();
        return 0;
    }
    char hint[CLOSEST_NAME_HINT_SIZE];
    const subcommand *found = subcommand_find(name);
    return found ? subcommand_print(found, "man")
                 : options_usage_error(table, "unknown subcommand '%s'%s", name,
                                       subcommand_hint(name, hint));
}

static int run(int argc, char **argv) {
    const option_table table = {
        .program = "lobe manual",
        .operands = "[SUBCOMMAND]",
        .summary =
            "Prints the manual page of the program, or of a subcommand, in roff: 'lobe manual\n"
            "render | man -l -' shows one that is not installed.",
        .maximum_operands = 1,
        .operand_values = OPTION_VALUES_SUBCOMMAND,
    };
    option_list operands = {0};
    int status;
    if (options_parse(&table, argc, argv, &operands, &status))
        status = print(&table, operands.count > 0 ? operands.values[0] : NULL);
    options_free(&table, &operands);
    return status;
}

const subcommand manual_subcommand = {"manual", "print a manual page in roff", run};
