#ifndef SCENES_FORMAT_TEXT_CURSOR_H
#define SCENES_FORMAT_TEXT_CURSOR_H

#include <stdbool.h>
#include <stddef.h>

/// Reading numbers and words out of text in memory, whatever the locale says.
typedef struct text_cursor {
    const char *at, *end;
} text_cursor;

/// Moves behind spaces, tabs and ends of lines.
void scenes_text_cursor_skip_space(text_cursor *cursor);

/// Moves behind `expected` where that is next, after space.
bool scenes_text_cursor_take(text_cursor *cursor, char expected);

/// Reads a decimal number, after space: digits with a point and an exponent where there are any.
/// False, nothing moved, where there is none, or one beyond the range of float.
bool scenes_text_cursor_number(text_cursor *cursor, double *value);

/// The same for a whole number [0, maximum] without sign, point or exponent.
bool scenes_text_cursor_integer(text_cursor *cursor, size_t maximum, size_t *value);

/// The line that the cursor is in, counted from 1; `begin` is where the text begins.
size_t scenes_text_cursor_line(const text_cursor *cursor, const char *begin);

#endif
