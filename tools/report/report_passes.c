#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/report/html.h"
#include "tools/report/plot_bars.h"
#include "tools/report/report.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_rows.h"

/// Passes of the filters at their defaults in a scene, as bars know them.
typedef struct pass_bars {
    plot_bar bars[REPORT_MAXIMUM_FILTERS];
    size_t bar_count;
    plot_bar_part *parts; ///< of all bars
    const char **kinds;   ///< names of passes, each once
    size_t kind_count;
} pass_bars;

static const sweep_row *row_of(const report *report, size_t scene, size_t filter) {
    return sweep_results_default(report->results, report->results->scenes[scene].name,
                                 report->filters[filter]);
}

static size_t count_passes(const report *report, size_t scene) {
    size_t count = 0;
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = row_of(report, scene, i);
        count += row ? row->pass_count : 0;
    }
    return count;
}

static size_t find_kind(pass_bars *bars, const char *name) {
    size_t kind = 0;
    while (kind < bars->kind_count && strcmp(bars->kinds[kind], name) != 0)
        ++kind;
    if (kind == bars->kind_count)
        bars->kinds[bars->kind_count++] = name;
    return kind;
}

/// Returns the parts added.
static size_t add_bar(pass_bars *bars, const sweep_row *row, plot_bar_part *parts) {
    for (size_t i = 0; i < row->pass_count; ++i) {
        double time = row->passes[i].milliseconds;
        parts[i] = (plot_bar_part){find_kind(bars, row->passes[i].name), time > 0 ? time : 0};
    }
    bars->bars[bars->bar_count++] = (plot_bar){row->filter, parts, row->pass_count};
    return row->pass_count;
}

static void write_far(const report *report, size_t scene) {
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = row_of(report, scene, i);
        if (!row || !report_is_far(row->filter))
            continue;
        fputs("<figcaption>Not drawn: ", report->page);
        html_text(report->page, row->filter);
        fputs(", ", report->page);
        report_number(report->page, row->rebuilt_ms, 4);
        fputs(" ms</figcaption>", report->page);
    }
}

static void draw(const report *report, size_t scene, pass_bars *bars) {
    size_t used = 0;
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = row_of(report, scene, i);
        if (row && row->pass_count > 0 && !report_is_far(row->filter))
            used += add_bar(bars, row, &bars->parts[used]);
    }
    char id[48];
    snprintf(id, sizeof id, "scene-%zu-passes", scene);
    const plot_bars plot = {.id = id,
                            .title = "Passes",
                            .x_title = "milliseconds of device time, maps rebuilt",
                            .kinds = bars->kinds,
                            .kind_count = bars->kind_count,
                            .bars = bars->bars,
                            .bar_count = bars->bar_count};
    fputs("<figure><h4>Passes of a frame, maps rebuilt</h4>\n", report->page);
    if (bars->bar_count > 0)
        plot_bars_draw(report->page, &plot);
    else
        fputs("<p>No passes were timed.</p>", report->page);
    if (report->results->scenes[scene].environment)
        fputs("<figcaption>Passes that prepare the environment are paid once, not in each frame; "
              "retained frames have none of those that build.</figcaption>",
              report->page);
    write_far(report, scene);
    fputs("</figure>\n", report->page);
}

lobe_result report_write_pass_bars(const report *report, size_t scene) {
    size_t count = count_passes(report, scene);
    pass_bars bars = {.parts = calloc(count + 1, sizeof *bars.parts),
                      .kinds = calloc(count + 1, sizeof *bars.kinds)};
    bool allocated = bars.parts && bars.kinds;
    if (allocated)
        draw(report, scene, &bars);
    free(bars.parts);
    free(bars.kinds);
    return allocated ? LOBE_OK
                     : lobe_host_fail(report->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                                      report->path);
}

// ---------------------------------------------------------------------------------------------
// Table

static double gigabytes_a_second(double bytes, double milliseconds) {
    return bytes > 0 && milliseconds > 0 ? bytes / milliseconds * 1e-6 : NAN;
}

static void write_pass(const report *report, const sweep_pass *pass, const char *filter,
                       size_t index) {
    FILE *page = report->page;
    double speed = gigabytes_a_second(pass->bytes, pass->milliseconds);
    double copy = gigabytes_a_second(pass->bytes, pass->copy_milliseconds);
    fputs("<tr>", page);
    report_filter_head(page, filter, index);
    report_text_cell(page, pass->name);
    report_text_cell(page, pass->once       ? "prepares the environment, once"
                           : pass->building ? "builds maps"
                                            : "each frame");
    fprintf(page, "<td>%u</td>", pass->count);
    report_number_cell(page, pass->milliseconds, 4);
    report_number_cell(page, pass->bytes > 0 ? pass->bytes * 1e-6 : NAN, 4);
    report_number_cell(page, speed, 3);
    report_number_cell(page, copy, 3);
    report_number_cell(page, speed / copy, 3);
    fputs("</tr>\n", page);
}

void report_write_passes(const report *report, size_t scene) {
    fputs("<details><summary>Passes in numbers</summary>\n", report->page);
    report_table_begin(
        report->page,
        "Passes of a frame in which every map is built, all of one name together. Bytes are those "
        "that must be read and written, where that is known; the copy is a plain device copy of as "
        "many bytes.",
        "<tr><th class=\"text\" scope=\"col\">filter</th><th class=\"text\" "
        "scope=\"col\">pass</th><th class=\"text\" scope=\"col\">when</th>"
        "<th scope=\"col\">count</th><th scope=\"col\">ms</th><th scope=\"col\">MB</th>"
        "<th scope=\"col\">GB/s</th><th scope=\"col\">copy, GB/s</th>"
        "<th scope=\"col\">pass / copy</th></tr>");
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = row_of(report, scene, i);
        for (size_t k = 0; row && k < row->pass_count; ++k)
            write_pass(report, &row->passes[k], row->filter, i);
    }
    report_table_end(report->page);
    fputs("</details>\n", report->page);
}
