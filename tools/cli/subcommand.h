#ifndef TOOLS_CLI_SUBCOMMAND_H
#define TOOLS_CLI_SUBCOMMAND_H

/// One of the things the program can do: `lobe NAME ...`.
typedef struct subcommand {
    const char *name;
    const char *summary; ///< one line for `lobe --help`
    /// argv[0] is the name, the rest its options and operands. Returns the exit status: 0 done, 1
    /// failed (with one line on standard error), 2 wrong usage.
    int (*run)(int argc, char **argv);
} subcommand;

extern const subcommand render_subcommand;
extern const subcommand view_subcommand;
extern const subcommand bench_subcommand;
extern const subcommand report_subcommand;
extern const subcommand compare_subcommand;
extern const subcommand environment_subcommand;
extern const subcommand prepare_subcommand;
extern const subcommand scenes_subcommand;
extern const subcommand filters_subcommand;
extern const subcommand info_subcommand;
extern const subcommand manual_subcommand;
extern const subcommand completion_subcommand;

/// All subcommands in the order of `lobe --help`; the last is NULL.
extern const subcommand *const subcommands[];
/// NULL if no subcommand has that name.
const subcommand *subcommand_find(const char *name);
/// What to add to the message that there is none: the name that may have been meant, or nothing.
/// Returns `hint`, of CLOSEST_NAME_HINT_SIZE bytes.
const char *subcommand_hint(const char *name, char *hint);
/// Makes a subcommand print its option table in another form (option_form_find) on standard output.
/// Returns the exit status.
int subcommand_print(const subcommand *subcommand, const char *form);

#endif
