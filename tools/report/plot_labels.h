#ifndef TOOLS_REPORT_PLOT_LABELS_H
#define TOOLS_REPORT_PLOT_LABELS_H

#include <stdbool.h>
#include <stddef.h>

/// Places labels beside points so that they cover each other, and what is drawn, as little as may
/// be.

#define PLOT_LABEL_HEIGHT 12.0 ///< of a line of text, in the plot's units

/// Width of a text in that height: an estimate that fits common sans-serif fonts.
double plot_text_width(const char *text);

typedef struct plot_box {
    double left, top, right, bottom;
} plot_box;

typedef struct plot_labels {
    plot_box bounds; ///< labels should stay within
    plot_box taken[512];
    double costs[512]; ///< of covering a unit of area of each
    size_t taken_count;
} plot_labels;

/// From now on labels keep away from the box. Where too many boxes are taken, it is not kept.
void plot_labels_take(plot_labels *labels, plot_box box);

/// Finds a place for a label of the point (x, y) and takes it.
plot_box plot_labels_place(plot_labels *labels, double x, double y, const char *text);

#endif
