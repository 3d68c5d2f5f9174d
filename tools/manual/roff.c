#include "tools/manual/roff.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

#include <lobe/lobe.h>

void roff_title(FILE *stream, const char *name) {
    fputs(".TH ", stream);
    for (; *name != '\0'; name++)
        fputc(toupper((unsigned char)*name), stream);
    // No date: the same source gives the same page.
    fprintf(stream, " 1 \"\" \"lobe %s\" \"User Commands\"\n", lobe_version());
}

void roff_section(FILE *stream, const char *title) {
    fprintf(stream, ".SH %s\n", title);
}

static void print_text(FILE *stream, const char *text, size_t length) {
    // At the start of a line these make it a request.
    if (length > 0 && (text[0] == '.' || text[0] == '\''))
        fputs("\\&", stream);
    for (size_t index = 0; index < length; index++) {
        switch (text[index]) {
        case '\\':
            fputs("\\e", stream);
            break;
        case '-': // otherwise a hyphen, which does not work when copied to a terminal
            fputs("\\-", stream);
            break;
        case '\'': // otherwise a curly apostrophe
            fputs("\\(aq", stream);
            break;
        case '^':
            fputs("\\(ha", stream);
            break;
        case '~':
            fputs("\\(ti", stream);
            break;
        default:
            fputc(text[index], stream);
        }
    }
}

void roff_text(FILE *stream, const char *text) {
    print_text(stream, text, strlen(text));
}

void roff_paragraphs(FILE *stream, const char *text) {
    bool verbatim = false;
    while (*text != '\0') {
        size_t length = strcspn(text, "\n");
        bool keep = strncmp(text, "  ", 2) == 0;
        if (keep != verbatim)
            fputs(keep ? ".nf\n" : ".fi\n", stream);
        verbatim = keep;
        if (length == 0)
            fputs(".PP", stream);
        print_text(stream, text, length);
        fputc('\n', stream);
        text += length + (text[length] == '\n');
    }
    if (verbatim)
        fputs(".fi\n", stream);
}

void roff_item(FILE *stream, const char *tag, const char *argument, const char *text) {
    fputs(".TP\n\\fB", stream);
    roff_text(stream, tag);
    fputs("\\fR", stream);
    if (argument != NULL) {
        fputs(" \\fI", stream);
        roff_text(stream, argument);
        fputs("\\fR", stream);
    }
    fputc('\n', stream);
    roff_text(stream, text);
    fputc('\n', stream);
}
