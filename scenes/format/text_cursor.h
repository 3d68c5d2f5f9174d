#ifndef SCENES_FORMAT_TEXT_CURSOR_H
#define SCENES_FORMAT_TEXT_CURSOR_H

#include <stdbool.h>
#include <stddef.h>

/// Reading numbers and words from text in memory, independent of the locale.
typedef struct text_cursor {
    const char *at, *end;
} text_cursor;

/// Moves past spaces, tabs and line ends.
void scenes_text_cursor_skip_space(text_cursor *cursor);

/// Moves past space and then `expected`. False if something else comes first.
bool scenes_text_cursor_take(text_cursor *cursor, char expected);

/// Reads a decimal number after space: digits, optionally with a point and an exponent. False,
/// without moving, if there is no number or it is beyond the range of float.
bool scenes_text_cursor_number(text_cursor *cursor, double *value);

/// The same for a whole number in [0, maximum] without sign, point or exponent.
bool scenes_text_cursor_integer(text_cursor *cursor, size_t maximum, size_t *value);

/// The line number of the cursor, from 1; `begin` is the beginning of the text.
size_t scenes_text_cursor_line(const text_cursor *cursor, const char *begin);

#endif
