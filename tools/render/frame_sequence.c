#include "tools/render/frame_sequence.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Reads digits; NULL if there are none, or they mean too large a number.
static const char *read_number(const char *text, uint32_t *number) {
    char *end;
    if (!isdigit((unsigned char)text[0]))
        return NULL;
    const unsigned long value = strtoul(text, &end, 10);
    *number = (uint32_t)value;
    return value <= FRAME_SEQUENCE_MAXIMUM ? end : NULL;
}

bool frame_sequence_parse(const char *text, frame_sequence *sequence) {
    uint32_t first, last;
    const char *end = read_number(text, &first);
    if (end && end[0] == '\0') {
        *sequence = (frame_sequence){.count = first};
        return first > 0;
    }
    if (!end || strncmp(end, "..", 2) != 0)
        return false;
    end = read_number(end + 2, &last);
    if (!end || end[0] != '\0' || last < first)
        return false;
    *sequence = (frame_sequence){.count = last - first + 1, .first = first, .numbered = true};
    return true;
}

double frame_sequence_seconds(const frame_sequence *sequence, double start, uint32_t n) {
    return sequence->numbered ? start + (double)(sequence->first + n) / FRAME_SEQUENCE_RATE : start;
}

bool frame_sequence_path(const frame_sequence *sequence, const char *path, uint32_t n,
                         char name[PATH_MAX]) {
    const char *ending = strrchr(path, '.');
    if (!sequence->numbered || !ending)
        return snprintf(name, PATH_MAX, "%s", path) < PATH_MAX;
    // As many digits as the last needs, so that names sort.
    const int digits = snprintf(NULL, 0, "%04u", sequence->first + sequence->count - 1);
    return snprintf(name, PATH_MAX, "%.*s-%0*u%s", (int)(ending - path), path, digits,
                    sequence->first + n, ending) < PATH_MAX;
}
