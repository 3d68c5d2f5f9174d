#ifndef TOOLS_MANUAL_OPTION_FORM_H
#define TOOLS_MANUAL_OPTION_FORM_H

#include "tools/cli/options.h"

/// The form of `--help=NAME`: "man" is the manual page; "bash", "zsh" and "fish" are the
/// subcommand's part of that shell's completion. NULL for any other name.
option_form *option_form_find(const char *name);

option_form manual_page_print;
option_form completion_bash_print;
option_form completion_zsh_print;
option_form completion_fish_print;

/// The kind of an option's values; never OPTION_VALUES_PLAIN.
option_values option_form_values(const option *option);
/// The last word of the program's name in the usage: "render" of "lobe render".
const char *option_form_subcommand(const option_table *table);

#endif
