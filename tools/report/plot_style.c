#include "tools/report/plot_style.h"

#include <math.h>

/// Okabe and Ito 2008, "Color Universal Design": told apart with every kind of colour vision. Their
/// yellow, too pale on white, is replaced by grey.
const char *plot_colour(size_t series) {
    static const char *const colours[PLOT_COLOURS] = {
        "#000000", "#e69f00", "#0072b2", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#7a7a7a",
    };
    return colours[series % PLOT_COLOURS];
}

const char *plot_dashes(size_t series) {
    static const char *const dashes[] = {"none", "6 3", "2 2", "8 2 2 2", "4 2", "1 3"};
    return dashes[series % (sizeof dashes / sizeof *dashes)];
}

// ---------------------------------------------------------------------------------------------
// Markers

/// A regular polygon, or with `inner` below 1 a star: every second corner that much nearer.
typedef struct marker_shape {
    int corners; ///< 0: a circle
    double turn; ///< of the first corner from straight up, degrees
    double inner, scale;
} marker_shape;

static const marker_shape shapes[PLOT_SHAPES] = {
    {0, 0, 1, 0.95},     // circle
    {4, 45, 1, 1.25},    // square
    {3, 0, 1, 1.3},      // triangle
    {4, 0, 1, 1.3},      // diamond
    {3, 180, 1, 1.3},    // triangle upside down
    {10, 0, 0.45, 1.4},  // star of five points
    {8, 45, 0.38, 1.45}, // cross
    {6, 0, 1, 1.1},      // hexagon
    {8, 0, 0.38, 1.45},  // star of four points
    {5, 180, 1, 1.15},   // pentagon
};

static void draw_corners(FILE *page, const marker_shape *shape, double x, double y, double size) {
    fputs("<polygon points=\"", page);
    for (int i = 0; i < shape->corners; ++i) {
        double angle = (shape->turn + 360.0 * i / shape->corners) * (M_PI / 180);
        double radius = size * shape->scale * (i % 2 ? shape->inner : 1);
        fprintf(page, "%s%.2f,%.2f", i ? " " : "", x + radius * sin(angle),
                y - radius * cos(angle));
    }
    putc('"', page);
}

void plot_draw_marker(FILE *page, size_t series, plot_marker marker, double x, double y,
                      double size) {
    const marker_shape *shape = &shapes[series % PLOT_SHAPES];
    const char *colour = plot_colour(series);
    if (shape->corners)
        draw_corners(page, shape, x, y, size);
    else
        fprintf(page, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"", x, y, size * shape->scale);
    if (marker == PLOT_MARKER_FULL)
        fprintf(page, " fill=\"%s\" stroke=\"#fff\" stroke-width=\".8\"/>", colour);
    else
        fprintf(page, " fill=\"#fff\" stroke=\"%s\" stroke-width=\"1.2\"/>", colour);
    if (marker == PLOT_MARKER_DOTTED)
        fprintf(page, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"%s\"/>", x, y, 0.4 * size,
                colour);
    if (marker == PLOT_MARKER_BARRED)
        fprintf(page, "<path d=\"M%.2f %.2fh%.2f\" stroke=\"%s\" stroke-width=\"1.4\"/>", x - size,
                y, 2 * size, colour);
}

void plot_draw_key(FILE *page, size_t series) {
    fputs("<svg class=\"key\" viewBox=\"0 0 14 14\" width=\"14\" height=\"14\" "
          "aria-hidden=\"true\">",
          page);
    plot_draw_marker(page, series, PLOT_MARKER_FULL, 7, 7, 4.5);
    fputs("</svg>", page);
}

// ---------------------------------------------------------------------------------------------
// Fills

typedef struct fill_tint {
    const char *area, *line;
} fill_tint;

static const fill_tint tints[] = {
    {"#f4f4f4", "#bbb"},    {"#fbe6b8", "#dca52e"}, {"#cfe3f2", "#6ea6cf"}, {"#cdeadf", "#55b894"},
    {"#f8d9c6", "#dd8a55"}, {"#dff1fb", "#86c1e4"}, {"#f2dfe9", "#cf93b4"}, {"#dcdcdc", "#9a9a9a"},
    {"#fff6d0", "#cdb23c"}, {"#e4e1f3", "#968ec9"},
};

/// Paths in a tile of 8 x 8.
static const char *const hatchings[] = {
    "",
    "M-2 10L10 -2M-2 2L2 -2M6 10L10 6",
    "M-2 -2L10 10M-2 6L2 10M6 -2L10 2",
    "M0 4H8",
    "M4 0V8",
    "M2 2h1.6M6 6h1.6",
};

void plot_define_fills(FILE *page, const char *prefix, size_t count) {
    fputs("<defs>", page);
    for (size_t i = 0; i < count; ++i) {
        size_t round = i / (sizeof tints / sizeof *tints);
        const fill_tint *tint = &tints[i % (sizeof tints / sizeof *tints)];
        const char *hatching = hatchings[(i + round) % (sizeof hatchings / sizeof *hatchings)];
        fprintf(page,
                "<pattern id=\"%s-%zu\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\">"
                "<rect width=\"8\" height=\"8\" fill=\"%s\"/>"
                "<path d=\"%s\" stroke=\"%s\" stroke-width=\"1.6\" fill=\"none\"/></pattern>",
                prefix, i, tint->area, hatching, tint->line);
    }
    fputs("</defs>", page);
}
