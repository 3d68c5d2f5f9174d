#ifndef TOOLS_MANUAL_ROFF_H
#define TOOLS_MANUAL_ROFF_H

#include <stdio.h>

/// Manual pages in roff with the macros of man(7), UTF-8.

/// The first line of a page: "lobe-render", in section 1.
void roff_title(FILE *stream, const char *name);

void roff_section(FILE *stream, const char *title);

/// Text on one line, without line end; characters special to roff are escaped.
void roff_text(FILE *stream, const char *text);

/// Lines of text; empty lines separate paragraphs. Lines that begin with two blanks keep their
/// layout.
void roff_paragraphs(FILE *stream, const char *text);

/// A tagged paragraph: the tag in bold, then `argument` in italics (may be NULL), then the text.
void roff_item(FILE *stream, const char *tag, const char *argument, const char *text);

#endif
