#ifndef TOOLS_CLI_OPTIONS_H
#define TOOLS_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// Command lines in the GNU manner: `--name VALUE`, `--name=VALUE`, `-o VALUE`, `-oVALUE`, options
/// and operands in any order, `--` ends the options. One table describes a subcommand's options;
/// parsing, checking, defaults and `--help` all come from it, so they cannot disagree.

/// What an option takes, and what its `target` points to.
typedef enum option_kind {
    OPTION_FLAG,    ///< no value; bool, set to true
    OPTION_TEXT,    ///< const char *, into argv or the table
    OPTION_INTEGER, ///< uint32_t
    OPTION_NUMBER,  ///< double, finite
    OPTION_SIZE,    ///< "WxH"; uint32_t[2], each in the range
    OPTION_VECTOR,  ///< "x,y,z"; float[3], finite, each in the range
    OPTION_CHOICE,  ///< one of `choices`; uint32_t, its index
    OPTION_LIST,    ///< may be repeated; option_list of texts
} option_kind;

/// The kind of values of an option or operand, for completion by shells.
typedef enum option_values {
    /// Follows from the rest of the entry: the choices; files if `argument` begins with FILE,
    /// folders if it begins with DIR; otherwise nothing.
    OPTION_VALUES_PLAIN,
    OPTION_VALUES_NONE,
    OPTION_VALUES_CHOICE,
    OPTION_VALUES_FILE,
    OPTION_VALUES_FOLDER,
    OPTION_VALUES_SCENE,       ///< built-in scenes, files and folders
    OPTION_VALUES_FILTER,      ///< filters
    OPTION_VALUES_FILTER_LIST, ///< filters separated by commas
    OPTION_VALUES_KNOB,        ///< KNOB=VALUE
    OPTION_VALUES_SUBCOMMAND,
} option_values;

/// Texts in the order given. Zero it before parsing; free it with option_list_free.
typedef struct option_list {
    const char **values; ///< the texts belong to argv or to the table
    size_t count;
} option_list;

typedef struct option {
    const char *name; ///< without the dashes; the table adds "help" itself
    char letter;      ///< short form; 0: none
    option_kind kind;
    const char *argument; ///< name of the value in the help, "FILE"; NULL for a flag
    const char *summary;  ///< one phrase; help adds range, choices and default
    void *target;         ///< see option_kind
    /// Used as if it had been given if the option is not; shown by help. NULL: the target is
    /// unchanged. For a list: a single value.
    const char *fallback;
    double minimum, maximum;    ///< inclusive; no limit if they are equal
    const char *const *choices; ///< ends with NULL
    option_values values;
    bool *given; ///< set to whether it was on the command line; may be NULL
} option;

typedef struct option_table {
    const char *program; ///< "lobe compare"
    const char
        *operands; ///< names of the operands in the help, "TEST REFERENCE"; NULL: there are none
    const char *summary; ///< what the subcommand does; may have several lines
    const option *options;
    size_t option_count;
    size_t minimum_operands, maximum_operands;
    option_values operand_values;
    /// Writes what the manual page contains beyond this table, in roff (tools/manual/roff.h). NULL:
    /// nothing.
    void (*manual)(FILE *stream);
} option_table;

/// Reads argv[1] to argv[argc - 1] into the targets. `operands` may be NULL if the table allows
/// none. Returns true to continue. Returns false if the subcommand must return `*status` at once: 0
/// after `--help` (printed on standard output), 2 after a mistake (one line on standard error), 1
/// if memory runs out. Always call options_free. `--help=FORM` prints the table in another form
/// (tools/manual/option_form.h), for the subcommands `manual` and `completion`.
bool options_parse(const option_table *table, int argc, char **argv, option_list *operands,
                   int *status);

/// Prints a table in some form.
typedef void option_form(const option_table *table, FILE *stream);

/// Sets the function that finds the form of `--help=FORM`, or NULL if there is no such form. Unless
/// it is set, there are no forms.
void options_set_form_finder(option_form *(*find)(const char *name));

/// Frees the lists that the table's options point to, and the operands (may be NULL).
void options_free(const option_table *table, option_list *operands);

/// Writes what `--help` shows.
void options_print_help(const option_table *table, FILE *stream);

/// The option that every table has without listing it.
extern const option option_help;

/// Range, choices, repetition and default, as printed after an option's summary: " [1, 9] (default
/// 3)", or "". Truncated to `size`.
void option_print_limits(const option *option, char *text, size_t size);

/// For mistakes that only the subcommand can detect: prints "PROGRAM: MESSAGE (see ...)" on
/// standard error, returns 2.
int options_usage_error(const option_table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Frees the list (not the texts) and zeroes it.
void option_list_free(option_list *list);

/// A finite decimal number that is the whole text.
bool option_parse_number(const char *text, double *value);
/// `count` numbers separated by single commas.
bool option_parse_numbers(const char *text, size_t count, double *values);

#endif
