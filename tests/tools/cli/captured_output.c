#include "tests/tools/cli/captured_output.h"

#include <stdio.h>
#include <unistd.h>

#include "tests/engine/support/cmocka_all.h"

/// A stream that is redirected to a file; `former` is its previous destination.
typedef struct redirection {
    FILE *stream, *file;
    int former;
} redirection;

static redirection redirect(FILE *stream) {
    fflush(stream);
    redirection redirection = {stream, tmpfile(), dup(fileno(stream))};
    assert_non_null(redirection.file);
    assert_true(dup2(fileno(redirection.file), fileno(stream)) >= 0);
    return redirection;
}

static void restore(redirection *redirection, char *text, size_t size) {
    fflush(redirection->stream);
    clearerr(redirection->stream);
    dup2(redirection->former, fileno(redirection->stream));
    close(redirection->former);
    rewind(redirection->file);
    size_t count = fread(text, 1, size - 1, redirection->file);
    text[count] = '\0';
    fclose(redirection->file);
}

void captured_output_run(captured_output *captured, int (*run)(int argc, char **argv),
                         const char *const *arguments) {
    int argc = 0;
    while (arguments[argc] != NULL)
        argc++;
    redirection output = redirect(stdout), errors = redirect(stderr);
    captured->status = run(argc, (char **)arguments);
    restore(&errors, captured->errors, sizeof captured->errors);
    restore(&output, captured->output, sizeof captured->output);
}

int captured_output_lines(const char *text) {
    int lines = 0;
    for (; *text != '\0'; text++)
        lines += *text == '\n';
    return lines;
}
