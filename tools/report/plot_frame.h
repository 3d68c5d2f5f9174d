#ifndef TOOLS_REPORT_PLOT_FRAME_H
#define TOOLS_REPORT_PLOT_FRAME_H

#include <stddef.h>
#include <stdio.h>

#include "tools/report/plot_axis.h"

/// What all plots have: an SVG element with a name for those who cannot see it, and axes about a
/// rectangle. Text is given unescaped.

typedef struct plot_frame {
    double left, top, right, bottom; ///< of the rectangle, in the plot's units
    plot_axis x, y;
} plot_frame;

/// Opens an SVG element; "</svg>" closes it. `id` is unique in the page.
void plot_begin(FILE *page, const char *id, double width, double height, const char *title,
                const char *description);

double plot_x(const plot_frame *frame, double value);
double plot_y(const plot_frame *frame, double value);

/// Lines across the rectangle, ticks and titles.
void plot_draw_x_axis(FILE *page, const plot_frame *frame, const char *title);
void plot_draw_y_axis(FILE *page, const plot_frame *frame, const char *title);

#endif
