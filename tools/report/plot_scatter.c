#include "tools/report/plot_scatter.h"

#include <math.h>
#include <stdbool.h>

#include "tools/report/html.h"
#include "tools/report/plot_frame.h"
#include "tools/report/plot_labels.h"
#include "tools/report/plot_pareto.h"
#include "tools/report/plot_style.h"

enum { WIDTH = 560, HEIGHT = 400, LEFT = 62, RIGHT = 16, TOP = 12, BOTTOM = 44, LEGEND_LINE = 17 };

static const double main_size = 5.2, small_size = 3.2, kind_size = 4.2, ring_size = 9;

static const plot_marker kind_markers[] = {PLOT_MARKER_HOLLOW, PLOT_MARKER_DOTTED,
                                           PLOT_MARKER_BARRED};

static bool is_main(const plot_scatter *plot, size_t index) {
    return plot->points[index].origin == index;
}

static double size_of_mark(const plot_scatter *plot, size_t index) {
    if (is_main(plot, index))
        return main_size;
    return plot->points[index].kind > 0 ? kind_size : small_size;
}

/// What an axis can show.
static bool is_shown(const plot_frame *frame, const plot_point *point) {
    return isfinite(point->x) && isfinite(point->y) && point->x >= frame->x.minimum &&
           point->y >= frame->y.minimum;
}

// ---------------------------------------------------------------------------------------------
// Legend

static double legend_width(const char *name) {
    return 16 + plot_text_width(name) + 14;
}

static bool has_points(const plot_scatter *plot, size_t series) {
    for (size_t i = 0; i < plot->point_count; ++i) {
        if (plot->points[i].series == series)
            return true;
    }
    return false;
}

/// In a line of their own.
static void draw_kinds(FILE *page, const plot_scatter *plot, double y) {
    double x = LEFT;
    for (size_t i = 0; i < plot->kind_count; ++i) {
        plot_draw_marker(page, 0, kind_markers[i], x + 6, y, kind_size);
        fprintf(page, "<text x=\"%.2f\" y=\"%.2f\">", x + 16, y + 4);
        html_text(page, plot->kinds[i]);
        fputs("</text>\n", page);
        x += legend_width(plot->kinds[i]);
    }
}

/// Draws it unless `page` is NULL; returns its lines.
static int draw_legend(FILE *page, const plot_scatter *plot) {
    double x = LEFT;
    int line = 0;
    for (size_t series = 0; series < plot->series_count; ++series) {
        if (!has_points(plot, series))
            continue;
        double width = legend_width(plot->series[series]);
        if (x + width > WIDTH && x > LEFT) {
            x = LEFT;
            ++line;
        }
        double y = TOP + LEGEND_LINE * line;
        if (page) {
            plot_draw_marker(page, series, PLOT_MARKER_FULL, x + 6, y, main_size);
            fprintf(page, "<text x=\"%.2f\" y=\"%.2f\">", x + 16, y + 4);
            html_text(page, plot->series[series]);
            fputs("</text>\n", page);
        }
        x += width;
    }
    if (plot->kind_count == 0)
        return line + 1;
    if (page)
        draw_kinds(page, plot, TOP + LEGEND_LINE * (line + 1));
    return line + 2;
}

// ---------------------------------------------------------------------------------------------
// Marks

/// From a point to what it varies, so that the eye finds a filter's own trade.
static void draw_variation_lines(FILE *page, const plot_scatter *plot, const plot_frame *frame) {
    for (size_t i = 0; i < plot->point_count; ++i) {
        const plot_point *point = &plot->points[i], *origin = &plot->points[point->origin];
        if (is_main(plot, i) || !is_shown(frame, point) || !is_shown(frame, origin))
            continue;
        fprintf(page,
                "<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" stroke-dasharray=\"%s\" "
                "stroke-width=\".8\" opacity=\".65\"/>",
                plot_x(frame, point->x), plot_y(frame, point->y), plot_x(frame, origin->x),
                plot_y(frame, origin->y), plot_colour(point->series), plot_dashes(point->series));
    }
    putc('\n', page);
}

static void draw_marks(FILE *page, const plot_scatter *plot, const plot_frame *frame, bool main) {
    for (size_t i = 0; i < plot->point_count; ++i) {
        const plot_point *point = &plot->points[i];
        if (is_main(plot, i) != main || !is_shown(frame, point))
            continue;
        fputs("<g><title>", page);
        html_text(page, point->about);
        fputs("</title>", page);
        plot_draw_marker(page, point->series, main ? PLOT_MARKER_FULL : kind_markers[point->kind],
                         plot_x(frame, point->x), plot_y(frame, point->y), size_of_mark(plot, i));
        fputs("</g>\n", page);
    }
}

// ---------------------------------------------------------------------------------------------
// Pareto front

static size_t find_front(const plot_scatter *plot, const plot_frame *frame, size_t *front) {
    plot_cost costs[PLOT_MAXIMUM_POINTS];
    for (size_t i = 0; i < plot->point_count; ++i) {
        const plot_point *point = &plot->points[i];
        bool shown = is_shown(frame, point);
        costs[i] = (plot_cost){shown ? point->x : NAN, point->y};
    }
    return plot_pareto_front(costs, plot->point_count, front);
}

/// Steps, as nothing is to be had between two choices: what lies above and right of them is worse
/// than some choice.
static void draw_front(FILE *page, const plot_scatter *plot, const plot_frame *frame,
                       const size_t *front, size_t count) {
    fputs("<path class=\"front\" d=\"", page);
    for (size_t i = 0; i < count; ++i) {
        const plot_point *point = &plot->points[front[i]];
        double x = plot_x(frame, point->x), y = plot_y(frame, point->y);
        if (i == 0)
            fprintf(page, "M%.2f %.2fV%.2f", x, frame->top, y);
        else
            fprintf(page, "H%.2fV%.2f", x, y);
    }
    fprintf(page, "H%.2f\"/>\n", frame->right);
    for (size_t i = 0; i < count; ++i) {
        const plot_point *point = &plot->points[front[i]];
        fprintf(page, "<circle class=\"ring\" cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>",
                plot_x(frame, point->x), plot_y(frame, point->y), ring_size);
    }
    putc('\n', page);
}

// ---------------------------------------------------------------------------------------------
// Labels

static size_t number_on_front(const size_t *front, size_t count, size_t index) {
    for (size_t i = 0; i < count; ++i) {
        if (front[i] == index)
            return i + 1;
    }
    return 0;
}

static void take_marks(plot_labels *labels, const plot_scatter *plot, const plot_frame *frame,
                       const size_t *front, size_t count) {
    for (size_t i = 0; i < plot->point_count; ++i) {
        const plot_point *point = &plot->points[i];
        if (!is_shown(frame, point))
            continue;
        double x = plot_x(frame, point->x), y = plot_y(frame, point->y);
        double size = size_of_mark(plot, i);
        if (number_on_front(front, count, i))
            size = ring_size;
        plot_labels_take(labels, (plot_box){x - size, y - size, x + size, y + size});
    }
}

static void draw_label(FILE *page, plot_labels *labels, double x, double y, const char *text) {
    plot_box box = plot_labels_place(labels, x, y, text);
    double near_x = fmin(fmax(x, box.left), box.right), near_y = fmin(fmax(y, box.top), box.bottom);
    if (hypot(near_x - x, near_y - y) > 12)
        fprintf(page, "<path class=\"leader\" d=\"M%.2f %.2fL%.2f %.2f\"/>", x, y, near_x, near_y);
    fprintf(page, "<text class=\"label\" x=\"%.2f\" y=\"%.2f\">", box.left, box.bottom - 2);
    html_text(page, text);
    fputs("</text>\n", page);
}

/// First those with names, which need the most room.
static void draw_labels(FILE *page, const plot_scatter *plot, const plot_frame *frame,
                        const size_t *front, size_t count) {
    plot_labels labels = {.bounds = {frame->left, frame->top, frame->right, frame->bottom}};
    take_marks(&labels, plot, frame, front, count);
    for (int named = 1; named >= 0; --named) {
        for (size_t i = 0; i < plot->point_count; ++i) {
            const plot_point *point = &plot->points[i];
            size_t number = number_on_front(front, count, i);
            if (is_main(plot, i) != named || (!named && !number) || !is_shown(frame, point))
                continue;
            const char *name = named ? plot->series[point->series] : "";
            char text[96], prefix[32] = "";
            if (number)
                snprintf(prefix, sizeof prefix, "%zu%s", number, named ? " " : "");
            snprintf(text, sizeof text, "%s%s", prefix, name);
            draw_label(page, &labels, plot_x(frame, point->x), plot_y(frame, point->y), text);
        }
    }
}

// ---------------------------------------------------------------------------------------------

static bool make_frame(const plot_scatter *plot, plot_frame *frame) {
    double x[PLOT_MAXIMUM_POINTS], y[PLOT_MAXIMUM_POINTS];
    size_t count = 0;
    for (size_t i = 0; i < plot->point_count; ++i) {
        const plot_point *point = &plot->points[i];
        if (isfinite(point->x) && isfinite(point->y) && point->x >= 0 && point->y >= 0) {
            x[count] = point->x;
            y[count++] = point->y;
        }
    }
    *frame = (plot_frame){.left = LEFT,
                          .top = TOP + LEGEND_LINE * draw_legend(NULL, plot),
                          .right = WIDTH - RIGHT,
                          .bottom = HEIGHT - BOTTOM,
                          .x = plot_axis_fit(x, count),
                          .y = plot_axis_fit(y, count)};
    return count > 0;
}

size_t plot_scatter_draw(FILE *page, const plot_scatter *plot, size_t *front) {
    plot_frame frame;
    if (!make_frame(plot, &frame))
        return 0;
    char description[256];
    snprintf(description, sizeof description,
             "%zu points; across: %s; up: %s. The list below names the points of the Pareto front.",
             plot->point_count, plot->x_title, plot->y_title);
    plot_begin(page, plot->id, WIDTH, HEIGHT, plot->title, description);
    plot_draw_x_axis(page, &frame, plot->x_title);
    plot_draw_y_axis(page, &frame, plot->y_title);
    draw_legend(page, plot);
    size_t count = find_front(plot, &frame, front);
    draw_variation_lines(page, plot, &frame);
    draw_front(page, plot, &frame, front, count);
    draw_marks(page, plot, &frame, false);
    draw_marks(page, plot, &frame, true);
    draw_labels(page, plot, &frame, front, count);
    fputs("</svg>\n", page);
    return count;
}
