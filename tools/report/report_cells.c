#include "tools/report/report_cells.h"

#include <math.h>

#include "tools/cli/number_text.h"
#include "tools/report/html.h"
#include "tools/report/plot_style.h"

void report_number(FILE *page, double value, int significant) {
    number_text text = number_text_of(value, significant);
    if (isfinite(value))
        fprintf(page, "<data value=\"%.9g\">%s</data>", value, text.text);
    else
        fputs(text.text, page);
}

void report_number_cell(FILE *page, double value, int significant) {
    fputs("<td>", page);
    report_number(page, value, significant);
    fputs("</td>", page);
}

void report_text_cell(FILE *page, const char *text) {
    fputs("<td class=\"text\">", page);
    html_text(page, text);
    fputs("</td>", page);
}

void report_head_cell(FILE *page, const char *text) {
    fputs("<th scope=\"row\">", page);
    html_text(page, text);
    fputs("</th>", page);
}

void report_filter_head(FILE *page, const char *name, size_t index) {
    fputs("<th scope=\"row\">", page);
    plot_draw_key(page, index);
    html_text(page, name);
    fputs("</th>", page);
}

void report_table_begin(FILE *page, const char *caption, const char *head) {
    fputs("<div class=\"table\"><table><caption>", page);
    html_text(page, caption);
    fprintf(page, "</caption>\n<thead>%s</thead>\n<tbody>\n", head);
}

void report_table_end(FILE *page) {
    fputs("</tbody></table></div>\n", page);
}
