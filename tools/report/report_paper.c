#include <math.h>

#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"

enum { PRINTED_COLUMNS = 5 };

/// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", table 1: milliseconds on their machine.
typedef struct printed_row {
    const char *printed_scene, *scene; ///< theirs, and the one that has its role here
    double milliseconds[PRINTED_COLUMNS];
} printed_row;

static const printed_row printed_rows[] = {
    {"Pillow", "pillow", {0.6, 0.6, 0.9, 59, 2.0}},
    {"Tablecloth", "tablecloth", {0.4, 0.4, 0.7, 50, 1.6}},
    {"Bunny", "bunny", {0.5, 0.5, 0.8, 51, 1.8}},
    {"Dragon", "dragon", {0.5, 0.6, 0.8, 54, 1.7}},
    {"Sponza", "hall", {1.6, 1.6, 1.9, 97, 2.5}},
};

/// The filters that stand for the columns.
static const char *const filters[PRINTED_COLUMNS] = {"direct", "mipmap", "lean", "reference",
                                                     "lobes"};

static double ours(const report *report, const printed_row *row, const char *filter,
                   const char *base) {
    return report_ratio(report, report_rebuilt, row->scene, filter, base);
}

static void write_row(const report *report, const printed_row *row) {
    FILE *page = report->page;
    fprintf(page, "<tr><th scope=\"row\">%s</th><th scope=\"row\">%s</th>", row->printed_scene,
            row->scene);
    fprintf(page, "<td>%g</td>", row->milliseconds[0]);
    report_number_cell(page, ours(report, row, "direct", NULL), 4);
    for (size_t i = 1; i < PRINTED_COLUMNS; ++i) {
        report_number_cell(page, row->milliseconds[i] / row->milliseconds[0], 3);
        report_number_cell(page, ours(report, row, filters[i], "direct"), 3);
    }
    report_number_cell(page, ours(report, row, "moments", "direct"), 3);
    fputs("</tr>\n", page);
}

void report_write_paper(const report *report) {
    fputs("<section id=\"paper\"><h2>Beside the paper’s table</h2>\n", report->page);
    report_table_begin(
        report->page,
        "Table 1 of Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, as printed, beside the same "
        "here: direct sampling in milliseconds, all else as ratios to it. Every map is built again "
        "in each frame; the reference takes 64 samples a pixel. The hall has the role of Sponza.",
        "<tr><th colspan=\"2\" scope=\"colgroup\">scene</th>"
        "<th colspan=\"2\" scope=\"colgroup\">direct, ms</th>"
        "<th colspan=\"2\" scope=\"colgroup\">MIP-map</th>"
        "<th colspan=\"2\" scope=\"colgroup\">LEAN</th>"
        "<th colspan=\"2\" scope=\"colgroup\">reference</th>"
        "<th colspan=\"2\" scope=\"colgroup\">their method (lobes)</th>"
        "<th scope=\"col\">moments</th></tr>\n"
        "<tr><th class=\"text\" scope=\"col\">theirs</th><th class=\"text\" scope=\"col\">ours</th>"
        "<th scope=\"col\">printed</th><th scope=\"col\">here</th>"
        "<th scope=\"col\">printed</th><th scope=\"col\">here</th>"
        "<th scope=\"col\">printed</th><th scope=\"col\">here</th>"
        "<th scope=\"col\">printed</th><th scope=\"col\">here</th>"
        "<th scope=\"col\">printed</th><th scope=\"col\">here</th>"
        "<th scope=\"col\">here</th></tr>");
    for (size_t i = 0; i < sizeof printed_rows / sizeof *printed_rows; ++i)
        write_row(report, &printed_rows[i]);
    report_table_end(report->page);
    fputs("</section>\n", report->page);
}
