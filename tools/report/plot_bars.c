#include "tools/report/plot_bars.h"

#include <math.h>
#include <stdbool.h>

#include "tools/report/html.h"
#include "tools/report/plot_frame.h"
#include "tools/report/plot_labels.h"
#include "tools/report/plot_style.h"

enum { WIDTH = 560, TOP = 8, RIGHT = 58, BAR = 26, THICKNESS = 18, AXIS = 46, LINE = 17 };

static double sum_of(const plot_bar *bar) {
    double sum = 0;
    for (size_t i = 0; i < bar->part_count; ++i)
        sum += bar->parts[i].value;
    return sum;
}

static plot_frame make_frame(const plot_bars *plot) {
    double widest = 0, longest = 0;
    for (size_t i = 0; i < plot->bar_count; ++i) {
        widest = fmax(widest, plot_text_width(plot->bars[i].name));
        longest = fmax(longest, sum_of(&plot->bars[i]));
    }
    return (plot_frame){.left = fmin(widest + 14, WIDTH / 3.0),
                        .top = TOP,
                        .right = WIDTH - RIGHT,
                        .bottom = TOP + BAR * (double)plot->bar_count,
                        .x = plot_axis_linear(longest)};
}

static void draw_part(FILE *page, const plot_bars *plot, const plot_bar_part *part, double left,
                      double right, double top) {
    fputs("<g><title>", page);
    html_text(page, plot->kinds[part->kind]);
    fprintf(page,
            ": %s</title><rect class=\"part\" x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" "
            "height=\"%d\" fill=\"url(#%s-%zu)\"/>",
            number_text_of(part->value, 4).text, left, top, right - left, THICKNESS, plot->id,
            part->kind);
    char number[16];
    snprintf(number, sizeof number, "%zu", part->kind + 1);
    if (right - left > plot_text_width(number) + 3)
        fprintf(page, "<text class=\"halo\" text-anchor=\"middle\" x=\"%.2f\" y=\"%.2f\">%s</text>",
                (left + right) / 2, top + 13, number);
    fputs("</g>", page);
}

static void draw_bar(FILE *page, const plot_bars *plot, const plot_frame *frame, size_t index) {
    const plot_bar *bar = &plot->bars[index];
    double top = frame->top + BAR * (double)index + (BAR - THICKNESS) / 2.0, sum = 0;
    fprintf(page, "<text text-anchor=\"end\" x=\"%.2f\" y=\"%.2f\">", frame->left - 8, top + 13);
    html_text(page, bar->name);
    fputs("</text>", page);
    for (size_t i = 0; i < bar->part_count; ++i) {
        double left = plot_x(frame, sum);
        sum += bar->parts[i].value;
        draw_part(page, plot, &bar->parts[i], left, plot_x(frame, sum), top);
    }
    fprintf(page, "<text x=\"%.2f\" y=\"%.2f\">%s</text>\n", plot_x(frame, sum) + 5, top + 13,
            number_text_of(sum, 4).text);
}

/// Of the legend: in two columns, or one where a name needs it.
static size_t count_lines(const plot_bars *plot) {
    double widest = 0;
    for (size_t i = 0; i < plot->kind_count; ++i)
        widest = fmax(widest, plot_text_width(plot->kinds[i]));
    bool two = widest + plot_text_width("00 ") + 28 < WIDTH / 2.0;
    return two ? (plot->kind_count + 1) / 2 : plot->kind_count;
}

/// Columns are filled from the top.
static void draw_legend(FILE *page, const plot_bars *plot, double top) {
    size_t lines = count_lines(plot);
    for (size_t i = 0; i < plot->kind_count; ++i) {
        double x = 8 + (double)(i / lines) * WIDTH / 2, y = top + LINE * (double)(i % lines);
        fprintf(page,
                "<rect class=\"part\" x=\"%.2f\" y=\"%.2f\" width=\"14\" height=\"12\" "
                "fill=\"url(#%s-%zu)\"/><text x=\"%.2f\" y=\"%.2f\">%zu ",
                x, y, plot->id, i, x + 20, y + 10.5, i + 1);
        html_text(page, plot->kinds[i]);
        fputs("</text>\n", page);
    }
}

void plot_bars_draw(FILE *page, const plot_bars *plot) {
    plot_frame frame = make_frame(plot);
    double legend = frame.bottom + AXIS;
    double height = legend + LINE * (double)count_lines(plot) + 4;
    plot_begin(page, plot->id, WIDTH, height, plot->title,
               "Stacked bars; the table of passes has the same numbers.");
    plot_define_fills(page, plot->id, plot->kind_count);
    plot_draw_x_axis(page, &frame, plot->x_title);
    for (size_t i = 0; i < plot->bar_count; ++i)
        draw_bar(page, plot, &frame, i);
    draw_legend(page, plot, legend);
    fputs("</svg>\n", page);
}
