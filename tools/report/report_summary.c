#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"

/// What the summary averages.
typedef struct summary_column {
    report_measure *measure;
    const char *base;
} summary_column;

static const summary_column columns[] = {
    {report_error, "direct"},   {report_error, "lobes"},     {report_flicker, NULL},
    {report_rebuilt, "direct"}, {report_retained, "direct"}, {report_bytes, NULL},
};

static size_t scenes_with(const report *report, const char *filter) {
    return report_mean_ratio(report, report_rebuilt, filter, NULL).scenes;
}

static void write_row(const report *report, size_t index) {
    const char *filter = report->filters[index];
    fputs("<tr>", report->page);
    report_filter_head(report->page, filter, index);
    fprintf(report->page, "<td>%zu</td>", scenes_with(report, filter));
    for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i) {
        report_mean mean = report_mean_ratio(report, columns[i].measure, filter, columns[i].base);
        report_number_cell(report->page, mean.arithmetic, 3);
        report_number_cell(report->page, mean.geometric, 3);
    }
    fputs("</tr>\n", report->page);
}

void report_write_summary(const report *report) {
    fputs("<section id=\"summary\"><h2>Summary</h2>\n", report->page);
    report_table_begin(
        report->page,
        "Each filter at its defaults: means over the scenes, arithmetic and geometric. Errors are "
        "relative L2; times are of whole frames.",
        "<tr><th class=\"text\" rowspan=\"2\" scope=\"col\">filter</th><th rowspan=\"2\" "
        "scope=\"col\">scenes</th>"
        "<th colspan=\"2\" scope=\"colgroup\">error /<br>error of direct</th>"
        "<th colspan=\"2\" scope=\"colgroup\">error /<br>error of lobes</th>"
        "<th colspan=\"2\" scope=\"colgroup\">flicker</th>"
        "<th colspan=\"2\" scope=\"colgroup\">time / direct,<br>maps rebuilt</th>"
        "<th colspan=\"2\" scope=\"colgroup\">time / direct,<br>maps retained</th>"
        "<th colspan=\"2\" scope=\"colgroup\">bytes<br>a texel</th></tr>\n"
        "<tr><th scope=\"col\">arith.</th><th scope=\"col\">geom.</th>"
        "<th scope=\"col\">arith.</th><th scope=\"col\">geom.</th>"
        "<th scope=\"col\">arith.</th><th scope=\"col\">geom.</th>"
        "<th scope=\"col\">arith.</th><th scope=\"col\">geom.</th>"
        "<th scope=\"col\">arith.</th><th scope=\"col\">geom.</th>"
        "<th scope=\"col\">arith.</th><th scope=\"col\">geom.</th></tr>");
    for (size_t i = 0; i < report->filter_count; ++i)
        write_row(report, i);
    report_table_end(report->page);
    fputs("</section>\n", report->page);
}
