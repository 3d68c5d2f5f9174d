#include "tools/report/plot_frame.h"

#include "tools/report/html.h"

void plot_begin(FILE *page, const char *id, double width, double height, const char *title,
                const char *description) {
    fprintf(page,
            "<svg class=\"plot\" viewBox=\"0 0 %g %g\" role=\"img\" "
            "aria-labelledby=\"%s-title %s-text\">\n<title id=\"%s-title\">",
            width, height, id, id, id);
    html_text(page, title);
    fprintf(page, "</title><desc id=\"%s-text\">", id);
    html_text(page, description);
    fputs("</desc>\n", page);
}

double plot_x(const plot_frame *frame, double value) {
    return frame->left + plot_axis_position(&frame->x, value) * (frame->right - frame->left);
}

double plot_y(const plot_frame *frame, double value) {
    return frame->bottom + plot_axis_position(&frame->y, value) * (frame->top - frame->bottom);
}

void plot_draw_x_axis(FILE *page, const plot_frame *frame, const char *title) {
    fputs("<g class=\"axis\" text-anchor=\"middle\">", page);
    for (size_t i = 0; i < frame->x.tick_count; ++i) {
        double x = plot_x(frame, frame->x.ticks[i]);
        fprintf(page, "<path d=\"M%.2f %.2fV%.2f\"/><text x=\"%.2f\" y=\"%.2f\">%s</text>", x,
                frame->top, frame->bottom + 4, x, frame->bottom + 17,
                plot_axis_label(frame->x.ticks[i]).text);
    }
    fprintf(page, "<path class=\"edge\" d=\"M%.2f %.2fH%.2f\"/>", frame->left, frame->bottom,
            frame->right);
    fprintf(page, "<text class=\"name\" x=\"%.2f\" y=\"%.2f\">", (frame->left + frame->right) / 2,
            frame->bottom + 35);
    html_text(page, title);
    fputs("</text></g>\n", page);
}

void plot_draw_y_axis(FILE *page, const plot_frame *frame, const char *title) {
    fputs("<g class=\"axis\" text-anchor=\"end\">", page);
    for (size_t i = 0; i < frame->y.tick_count; ++i) {
        double y = plot_y(frame, frame->y.ticks[i]);
        fprintf(page, "<path d=\"M%.2f %.2fH%.2f\"/><text x=\"%.2f\" y=\"%.2f\">%s</text>",
                frame->left - 4, y, frame->right, frame->left - 7, y + 4,
                plot_axis_label(frame->y.ticks[i]).text);
    }
    fprintf(page, "<path class=\"edge\" d=\"M%.2f %.2fV%.2f\"/>", frame->left, frame->top,
            frame->bottom);
    double middle = (frame->top + frame->bottom) / 2;
    fprintf(page,
            "<text class=\"name\" text-anchor=\"middle\" transform=\"translate(14 %.2f) "
            "rotate(-90)\">",
            middle);
    html_text(page, title);
    fputs("</text></g>\n", page);
}
