#include "tools/report/html.h"

#include <stdbool.h>
#include <string.h>

static const char replacement[] = "\xef\xbf\xbd";

static const char *escape(unsigned char character) {
    switch (character) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return (character < 0x20 && !strchr("\t\n", character)) || character == 0x7f ? replacement
                                                                                     : NULL;
    }
}

/// Bytes of the sequence that a first byte above 0x7f begins, 0 where it can begin none, and the
/// range of its second byte, which excludes overlong forms, surrogates and what lies beyond
/// U+10FFFF. The Unicode Standard, table 3-7.
static size_t sequence_length(unsigned char first, unsigned char range[2]) {
    range[0] = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    range[1] = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (first >= 0xc2 && first <= 0xdf)
        return 2;
    if (first >= 0xe0 && first <= 0xef)
        return 3;
    return first >= 0xf0 && first <= 0xf4 ? 4 : 0;
}

/// Bytes of a well-formed sequence at `text`, 0 where there is none. C1 controls count as none.
static size_t multibyte(const unsigned char *text) {
    unsigned char range[2];
    size_t length = sequence_length(text[0], range);
    if (length == 0 || text[1] < range[0] || text[1] > range[1])
        return 0;
    for (size_t i = 2; i < length; ++i) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    }
    return text[0] == 0xc2 && text[1] < 0xa0 ? 0 : length;
}

void html_text(FILE *page, const char *text) {
    const unsigned char *at = (const unsigned char *)text;
    while (*at) {
        size_t length = *at < 0x80 ? 1 : multibyte(at);
        const char *escaped = length == 1 ? escape(*at) : length == 0 ? replacement : NULL;
        if (escaped)
            fputs(escaped, page);
        else
            fwrite(at, 1, length, page);
        at += length == 0 ? 1 : length;
    }
}

void html_base64(FILE *page, const uint8_t *data, size_t size) {
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t rest = size - i;
        uint32_t bits = (uint32_t)data[i] << 16;
        bits |= rest > 1 ? (uint32_t)data[i + 1] << 8 : 0;
        bits |= rest > 2 ? data[i + 2] : 0;
        const char group[4] = {
            letters[bits >> 18],
            letters[bits >> 12 & 63],
            rest > 1 ? letters[bits >> 6 & 63] : '=',
            rest > 2 ? letters[bits & 63] : '=',
        };
        fwrite(group, 1, sizeof group, page);
    }
}
