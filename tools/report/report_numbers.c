#include <math.h>
#include <string.h>

#include "tools/report/html.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"
#include "tools/report/report_rows.h"

#define COST_AND_ERROR_HEAD                                                                        \
    "<th scope=\"col\">rebuilt,<br>ms</th><th scope=\"col\">retained,<br>ms</th>"                  \
    "<th scope=\"col\">building,<br>ms</th><th scope=\"col\">the rest,<br>ms</th>"                 \
    "<th scope=\"col\">bytes<br>a texel</th><th scope=\"col\">memory,<br>MiB</th>"                 \
    "<th scope=\"col\">relative<br>L2</th><th scope=\"col\">relative<br>L1</th>"                   \
    "<th scope=\"col\">FLIP</th><th scope=\"col\">L2, lobes<br>as base</th>"                       \
    "<th scope=\"col\">flicker</th>"

static void write_cells(FILE *page, const sweep_row *row) {
    report_number_cell(page, row->rebuilt_ms, 4);
    report_number_cell(page, row->retained_ms, 4);
    report_number_cell(page, row->building_ms, 4);
    report_number_cell(page, row->shading_ms, 4);
    report_number_cell(page, row->bytes_per_texel, 3);
    report_number_cell(page, (double)row->memory_bytes / (1 << 20), 3);
    report_number_cell(page, row->error.relative_l2, 4);
    report_number_cell(page, row->error.relative_l1, 4);
    report_number_cell(page, row->error.flip, 4);
    report_number_cell(page, row->error_lobe_base.relative_l2, 4);
    report_number_cell(page, report_flicker(row), 4);
}

// ---------------------------------------------------------------------------------------------
// Defaults

static void write_settings(FILE *page, const sweep_row *row) {
    fputs("<td class=\"text\">", page);
    for (size_t i = 0; i < row->setting_count; ++i) {
        fputs(i > 0 ? ", " : "", page);
        html_text(page, row->settings[i].name);
        fputs("&nbsp;", page);
        html_text(page, row->settings[i].value);
    }
    fputs("</td>", page);
}

void report_write_numbers(const report *report, size_t scene) {
    const char *name = report->results->scenes[scene].name;
    report_table_begin(report->page, "Each filter at its defaults.",
                       "<tr><th class=\"text\" scope=\"col\">filter</th>" COST_AND_ERROR_HEAD
                       "<th class=\"text\" scope=\"col\">knobs</th></tr>");
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = sweep_results_default(report->results, name, report->filters[i]);
        if (!row)
            continue;
        fputs("<tr>", report->page);
        report_filter_head(report->page, row->filter, i);
        write_cells(report->page, row);
        write_settings(report->page, row);
        fputs("</tr>\n", report->page);
    }
    report_table_end(report->page);
}

// ---------------------------------------------------------------------------------------------
// Variations

static void write_variation(const report *report, const sweep_row *row, size_t filter) {
    fputs("<tr>", report->page);
    report_filter_head(report->page, row->filter, filter);
    report_text_cell(report->page, row->varied);
    report_text_cell(report->page, report_varied_value(row));
    write_cells(report->page, row);
    fputs("</tr>\n", report->page);
}

static bool is_variation(const sweep_row *row, const char *scene, const char *filter) {
    return row->varied[0] != '\0' && strcmp(row->scene, scene) == 0 &&
           strcmp(row->filter, filter) == 0;
}

static size_t count_variations(const sweep_results *results, const char *scene) {
    size_t count = 0;
    for (size_t i = 0; i < results->row_count; ++i)
        count += is_variation(&results->rows[i], scene, results->rows[i].filter);
    return count;
}

void report_write_variations(const report *report, size_t scene) {
    const sweep_results *results = report->results;
    const char *name = results->scenes[scene].name;
    size_t count = count_variations(results, name);
    if (count == 0)
        return;
    fprintf(report->page, "<details><summary>Knobs turned: %zu variation%s</summary>\n", count,
            count == 1 ? "" : "s");
    report_table_begin(
        report->page, "One knob turned, all others at their defaults.",
        "<tr><th class=\"text\" scope=\"col\">filter</th><th class=\"text\" scope=\"col\">knob</th>"
        "<th class=\"text\" scope=\"col\">value</th>" COST_AND_ERROR_HEAD "</tr>");
    for (size_t filter = 0; filter < report->filter_count; ++filter) {
        for (size_t i = 0; i < results->row_count; ++i) {
            if (is_variation(&results->rows[i], name, report->filters[filter]))
                write_variation(report, &results->rows[i], filter);
        }
    }
    report_table_end(report->page);
    fputs("</details>\n", report->page);
}
