#include "tools/report/plot_labels.h"

#include <math.h>

double plot_text_width(const char *text) {
    size_t characters = 0;
    for (; *text; ++text)
        characters += (*text & 0xc0) != 0x80;
    return 0.6 * PLOT_LABEL_HEIGHT * (double)characters;
}

static void take(plot_labels *labels, plot_box box, double cost) {
    if (labels->taken_count == sizeof labels->taken / sizeof *labels->taken)
        return;
    labels->costs[labels->taken_count] = cost;
    labels->taken[labels->taken_count++] = box;
}

void plot_labels_take(plot_labels *labels, plot_box box) {
    take(labels, box, 1);
}

static double area(const plot_box *box) {
    return (box->right - box->left) * (box->bottom - box->top);
}

static double common_area(const plot_box *a, const plot_box *b) {
    double width = fmin(a->right, b->right) - fmax(a->left, b->left);
    double height = fmin(a->bottom, b->bottom) - fmax(a->top, b->top);
    return width > 0 && height > 0 ? width * height : 0;
}

/// What it covers; to stick out of the plot is worse still.
static double badness(const plot_labels *labels, const plot_box *box) {
    double sum = 10 * (area(box) - common_area(box, &labels->bounds));
    for (size_t i = 0; i < labels->taken_count; ++i)
        sum += labels->costs[i] * common_area(box, &labels->taken[i]);
    return sum;
}

/// A box that touches a circle about the point, in direction (dx, dy) of -1, 0 or 1.
static plot_box beside(double x, double y, int dx, int dy, double distance, double width) {
    double reach = dx && dy ? distance * M_SQRT1_2 : distance;
    double left = x + dx * reach - (dx < 0 ? width : dx == 0 ? width / 2 : 0);
    double top = y + dy * reach - PLOT_LABEL_HEIGHT * (1 - dy) / 2;
    return (plot_box){left, top, left + width, top + PLOT_LABEL_HEIGHT};
}

plot_box plot_labels_place(plot_labels *labels, double x, double y, const char *text) {
    static const int directions[][2] = {{1, 0},  {-1, 0}, {0, -1},  {0, 1},
                                        {1, -1}, {1, 1},  {-1, -1}, {-1, 1}};
    static const double distances[] = {9, 16, 26, 40, 58};
    double width = plot_text_width(text), least = INFINITY;
    plot_box best = {0};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; ++i) {
        for (size_t k = 0; k < sizeof directions / sizeof *directions; ++k) {
            plot_box box = beside(x, y, directions[k][0], directions[k][1], distances[i], width);
            // A label far from its point is nearly as bad as one that covers a little.
            double score = badness(labels, &box) + 1.2 * (distances[i] - distances[0]);
            if (score < least) {
                least = score;
                best = box;
            }
        }
    }
    // Two texts upon each other cannot be read; a mark behind a text still can.
    take(labels, best, 8);
    return best;
}
