#ifndef TOOLS_REPORT_PLOT_BARS_H
#define TOOLS_REPORT_PLOT_BARS_H

#include <stddef.h>
#include <stdio.h>

/// Stacked bars, lying, as an SVG with a legend of their parts.

typedef struct plot_bar_part {
    size_t kind;  ///< index into the plot's
    double value; ///< not negative
} plot_bar_part;

typedef struct plot_bar {
    const char *name;
    const plot_bar_part *parts; ///< from left to right
    size_t part_count;
} plot_bar;

typedef struct plot_bars {
    const char *id; ///< unique in the page
    const char *title, *x_title;
    const char *const *kinds; ///< names, shown as 1, 2, 3 ... in the parts and the legend
    size_t kind_count;
    const plot_bar *bars;
    size_t bar_count;
} plot_bars;

void plot_bars_draw(FILE *page, const plot_bars *plot);

#endif
