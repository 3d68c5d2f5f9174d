#ifndef TOOLS_REPORT_PLOT_STYLE_H
#define TOOLS_REPORT_PLOT_STYLE_H

#include <stddef.h>
#include <stdio.h>

/// How the series of a plot are told apart: by colour on a screen, by shape and dashes in print and
/// by those who see colours otherwise. The same index looks the same in every plot.

/// So many differ in colour and shape alike; more go on from the first colour with other shapes.
#define PLOT_COLOURS 8
#define PLOT_SHAPES  10

/// "#rrggbb"
const char *plot_colour(size_t series);

/// Value of stroke-dasharray; "none" for a full line.
const char *plot_dashes(size_t series);

typedef enum plot_marker {
    PLOT_MARKER_FULL,
    PLOT_MARKER_HOLLOW,
    PLOT_MARKER_DOTTED, ///< hollow, with a dot in the middle
    PLOT_MARKER_BARRED, ///< hollow, with a bar across
} plot_marker;

/// Draws the series' mark about (x, y), `size` from its middle to its edge, in the plot's units.
void plot_draw_marker(FILE *page, size_t series, plot_marker marker, double x, double y,
                      double size);

/// A marker as an inline SVG of its own, to stand in a line of text.
void plot_draw_key(FILE *page, size_t series);

/// Area fills, light enough for dark text upon them: a tint and a hatching. Defines those below
/// `count` as patterns named "PREFIX-0" and so on, to be used as fill="url(#PREFIX-0)".
void plot_define_fills(FILE *page, const char *prefix, size_t count);

#endif
