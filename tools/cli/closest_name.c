#include "tools/cli/closest_name.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/// Longer names have no typing errors worth guessing at.
#define MAXIMUM_LENGTH 48
/// Fewer letters do not say which longer name they begin.
#define MINIMUM_BEGINNING 3

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

/// The next row of the matrix of distances between beginnings of `name` and of `candidate`: `row`
/// letters of the candidate.
static void fill_row(const char *name, size_t length, const char *candidate, size_t row,
                     size_t rows[3][MAXIMUM_LENGTH + 1]) {
    const size_t *two_before = rows[(row + 1) % 3], *before = rows[(row + 2) % 3];
    size_t *now = rows[row % 3];
    now[0] = row;
    for (size_t i = 1; i <= length; i++) {
        const bool same = name[i - 1] == candidate[row - 1];
        now[i] = least(least(now[i - 1], before[i]) + 1, before[i - 1] + !same);
        if (i > 1 && row > 1 && name[i - 1] == candidate[row - 2] &&
            name[i - 2] == candidate[row - 1])
            now[i] = least(now[i], two_before[i - 2] + 1);
    }
}

/// How many letters must be inserted, deleted, replaced or swapped with their neighbours: the
/// distance of Damerau 1964, A technique for computer detection and correction of spelling errors.
static size_t count_edits(const char *name, size_t length, const char *candidate) {
    size_t rows[3][MAXIMUM_LENGTH + 1];
    const size_t count = strlen(candidate);
    for (size_t i = 0; i <= length; i++)
        rows[0][i] = i;
    for (size_t row = 1; row <= count; row++)
        fill_row(name, length, candidate, row, rows);
    return rows[count % 3][length];
}

void closest_name_offer(closest_name *closest, const char *candidate) {
    const size_t length = closest->length;
    if (length == 0 || length > MAXIMUM_LENGTH)
        return;
    const bool begins = length >= MINIMUM_BEGINNING && !strncmp(closest->name, candidate, length);
    const size_t distance = count_edits(closest->name, length, candidate);
    const size_t edits = begins ? least(distance, 1) : distance;
    const size_t limit = closest->closest ? closest->edits : (length + 2) / 3 + 1;
    if (edits >= limit || edits == length)
        return;
    closest->closest = candidate;
    closest->edits = edits;
}

const char *closest_name_hint(const closest_name *closest, const char *prefix,
                              char hint[CLOSEST_NAME_HINT_SIZE]) {
    hint[0] = '\0';
    if (closest->closest)
        snprintf(hint, CLOSEST_NAME_HINT_SIZE, "; did you mean '%s%s'?", prefix, closest->closest);
    return hint;
}
