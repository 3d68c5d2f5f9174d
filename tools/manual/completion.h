#ifndef TOOLS_MANUAL_COMPLETION_H
#define TOOLS_MANUAL_COMPLETION_H

#include <stdio.h>

#include <lobe/filter.h>

/// A completion script is a header with all names, one part per subcommand (in the shell's form,
/// tools/manual/option_form.h), and a footer.
typedef struct completion_shell {
    const char *name; ///< of the form, too
    void (*begin)(FILE *stream);
    void (*end)(FILE *stream);
} completion_shell;

extern const completion_shell completion_bash;
extern const completion_shell completion_zsh;
extern const completion_shell completion_fish;

/// Calls `visit` for the knobs of all filters, once per name, with the choices of all filters
/// together.
void completion_visit_knobs(void (*visit)(FILE *stream, const lobe_knob *knob), FILE *stream);

/// Text between single quotes for bash and zsh. Escapes backslashes and each of the characters
/// `special` by a backslash.
void completion_quote(FILE *stream, const char *text, const char *special);

#endif
