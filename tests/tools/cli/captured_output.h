#ifndef TESTS_TOOLS_CLI_CAPTURED_OUTPUT_H
#define TESTS_TOOLS_CLI_CAPTURED_OUTPUT_H

/// The output of a subcommand, and its exit status.
typedef struct captured_output {
    int status;
    char output[8192]; ///< standard output, cut off at the end
    char errors[4096]; ///< standard error
} captured_output;

/// Runs a subcommand with the arguments (the first is its name, the last is NULL).
void captured_output_run(captured_output *captured, int (*run)(int argc, char **argv),
                         const char *const *arguments);

/// Counts the lines of a text.
int captured_output_lines(const char *text);

#endif
