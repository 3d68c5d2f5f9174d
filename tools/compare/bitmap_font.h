#ifndef TOOLS_COMPARE_BITMAP_FONT_H
#define TOOLS_COMPARE_BITMAP_FONT_H

#include <stdbool.h>

/// Capitals, digits and some signs, as dots. Small letters look like capitals; characters that the
/// font lacks are blank.
#define BITMAP_FONT_WIDTH  5
#define BITMAP_FONT_HEIGHT 7

/// Whether dot (x, y) of a character is set, from its top left corner.
bool bitmap_font_dot(char character, int x, int y);

#endif
