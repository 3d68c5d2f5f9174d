#ifndef TOOLS_REPORT_PLOT_SCATTER_H
#define TOOLS_REPORT_PLOT_SCATTER_H

#include <stddef.h>
#include <stdio.h>

/// Choices by two costs, as an SVG: a mark for each, a ring and a stepped line for the Pareto
/// front, whose marks are numbered from left to right.

typedef struct plot_point {
    double x, y;       ///< not drawn where one is not finite or negative
    size_t series;     ///< index into the plot's
    size_t origin;     ///< the point it is a variation of; its own index: of none
    const char *about; ///< shown where a pointer rests on the mark
    size_t kind;       ///< of a variation: index into the plot's, below 3
} plot_point;

typedef struct plot_scatter {
    const char *id; ///< unique in the page
    const char *title, *x_title, *y_title;
    const char *const *series; ///< names
    size_t series_count;
    const plot_point *points; ///< at most PLOT_MAXIMUM_POINTS
    size_t point_count;
    const char *const *kinds; ///< names, told apart by what is in a variation's mark
    size_t kind_count;        ///< 0: they are not
} plot_scatter;

#define PLOT_MAXIMUM_POINTS 1024

/// Writes the indices of the numbered points to `front` (room for all points), returns how many.
/// A plot without points to draw writes nothing and returns 0.
size_t plot_scatter_draw(FILE *page, const plot_scatter *plot, size_t *front);

#endif
