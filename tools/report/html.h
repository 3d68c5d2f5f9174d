#ifndef TOOLS_REPORT_HTML_H
#define TOOLS_REPORT_HTML_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// HTML5 into a stream; what goes wrong there is asked of the stream once, at the end.

/// Text as it may stand between tags and in quoted attributes, in HTML and in SVG: & < > " ' are
/// escaped; control characters, and bytes that are no UTF-8, become U+FFFD.
void html_text(FILE *page, const char *text);

/// Binary data in the letters of a data: URI (RFC 4648, section 4).
void html_base64(FILE *page, const uint8_t *data, size_t size);

#endif
