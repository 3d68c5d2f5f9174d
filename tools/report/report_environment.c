#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/report/html.h"
#include "tools/report/report.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_rows.h"

// ---------------------------------------------------------------------------------------------
// How a scene is lit

void report_write_light(const report *report, size_t scene) {
    const sweep_scene *lit = &report->results->scenes[scene];
    FILE *page = report->page;
    if (!lit->environment && !lit->lighting)
        return;
    fputs("<p>", page);
    if (lit->environment) {
        fputs("Lit by the environment ", page);
        html_text(page, lit->environment);
    }
    if (lit->lighting) {
        fputs(lit->environment ? "; " : "Light: ", page);
        html_text(page, lit->lighting);
    }
    fputs(".", page);
    if (isfinite(lit->noise)) {
        fputs(" Chance leaves a relative L2 error of ", page);
        report_number(page, lit->noise, 3);
        fputs(" in the reference: maps of errors show it, numbers are without it.", page);
    }
    fputs("</p>\n", page);
}

// ---------------------------------------------------------------------------------------------
// Filter by method

/// The row of a filter that has all knobs at their defaults, but for the method.
static const sweep_row *find_row(const report *report, const char *scene, const char *filter,
                                 const char *method) {
    for (size_t i = 0; i < report->results->row_count; ++i) {
        const sweep_row *row = &report->results->rows[i];
        const bool plain = row->varied[0] == '\0' || strcmp(row->varied, "env") == 0;
        const char *value = sweep_row_value(row, "env");
        if (plain && value && strcmp(value, method) == 0 && strcmp(row->scene, scene) == 0 &&
            strcmp(row->filter, filter) == 0)
            return row;
    }
    return NULL;
}

static void write_cells(const report *report, const sweep_row *row) {
    report_number_cell(report->page, row ? row->error.relative_l2 : (double)NAN, 4);
    report_number_cell(report->page, row ? row->shading_ms : (double)NAN, 4);
    report_number_cell(report->page, row ? row->environment_ms : (double)NAN, 4);
}

static bool has_row(const report *report, const char *scene, const char *filter) {
    for (size_t i = 0; i < REPORT_METHODS; ++i) {
        if (find_row(report, scene, filter, report_methods[i]))
            return true;
    }
    return false;
}

static void write_head(char head[2048]) {
    char groups[640] = "", columns[1024] = "";
    for (size_t i = 0; i < REPORT_METHODS; ++i) {
        char text[256];
        snprintf(text, sizeof text, "<th colspan=\"3\" scope=\"colgroup\">%s</th>",
                 report_methods[i]);
        strcat(groups, text);
        strcat(columns, "<th scope=\"col\">relative<br>L2</th><th scope=\"col\">shading,<br>ms</th>"
                        "<th scope=\"col\">preparing,<br>ms</th>");
    }
    snprintf(head, 2048,
             "<tr><th class=\"text\" rowspan=\"2\" scope=\"col\">filter</th>%s</tr>\n<tr>%s</tr>",
             groups, columns);
}

void report_write_methods(const report *report, size_t scene) {
    const sweep_scene *lit = &report->results->scenes[scene];
    if (!lit->environment)
        return;
    char head[2048];
    write_head(head);
    report_table_begin(
        report->page,
        "Filters by methods of integrating the environment, all other knobs at their defaults. "
        "The environment is prepared once, all else is paid in each frame.",
        head);
    for (size_t i = 0; i < report->filter_count; ++i) {
        if (!has_row(report, lit->name, report->filters[i]))
            continue;
        fputs("<tr>", report->page);
        report_filter_head(report->page, report->filters[i], i);
        for (size_t k = 0; k < REPORT_METHODS; ++k)
            write_cells(report, find_row(report, lit->name, report->filters[i], report_methods[k]));
        fputs("</tr>\n", report->page);
    }
    report_table_end(report->page);
}
