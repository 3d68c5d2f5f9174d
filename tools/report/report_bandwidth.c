#include <math.h>
#include <string.h>

#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"

/// A filter's pass over the scenes.
typedef struct bandwidth {
    size_t scenes;
    double least, most;           ///< gigabytes a second
    double copy_least, copy_most; ///< likewise; NaN: no copy was timed
    double logarithms;            ///< sum over `copies` of log(pass / copy)
    size_t copies;
} bandwidth;

static const sweep_pass *find_pass(const sweep_row *row, const char *name) {
    for (size_t i = 0; row && i < row->pass_count; ++i) {
        if (strcmp(row->passes[i].name, name) == 0)
            return &row->passes[i];
    }
    return NULL;
}

static bool is_measured(const sweep_pass *pass) {
    return pass && pass->building && pass->bytes > 0 && pass->milliseconds > 0;
}

static void add(bandwidth *sum, const sweep_pass *pass) {
    double speed = pass->bytes / pass->milliseconds * 1e-6;
    sum->least = fmin(sum->least, speed);
    sum->most = fmax(sum->most, speed);
    ++sum->scenes;
    if (pass->copy_milliseconds <= 0)
        return;
    double copy = pass->bytes / pass->copy_milliseconds * 1e-6;
    sum->copy_least = fmin(sum->copy_least, copy);
    sum->copy_most = fmax(sum->copy_most, copy);
    sum->logarithms += log(speed / copy);
    ++sum->copies;
}

static bandwidth measure(const report *report, const char *filter, const char *pass) {
    bandwidth sum = {.least = NAN, .most = NAN, .copy_least = NAN, .copy_most = NAN};
    for (size_t i = 0; i < report->results->scene_count; ++i) {
        const char *scene = report->results->scenes[i].name;
        const sweep_pass *found =
            find_pass(sweep_results_default(report->results, scene, filter), pass);
        if (is_measured(found))
            add(&sum, found);
    }
    return sum;
}

static void write_range(FILE *page, double least, double most) {
    fputs("<td>", page);
    report_number(page, least, 3);
    if (most > least) {
        fputs(" – ", page);
        report_number(page, most, 3);
    }
    fputs("</td>", page);
}

static void write_row(const report *report, size_t filter, const char *pass) {
    bandwidth sum = measure(report, report->filters[filter], pass);
    fputs("<tr>", report->page);
    report_filter_head(report->page, report->filters[filter], filter);
    report_text_cell(report->page, pass);
    fprintf(report->page, "<td>%zu</td>", sum.scenes);
    write_range(report->page, sum.least, sum.most);
    write_range(report->page, sum.copy_least, sum.copy_most);
    double ratio = sum.copies ? exp(sum.logarithms / (double)sum.copies) : NAN;
    report_number_cell(report->page, ratio, 3);
    fputs("</tr>\n", report->page);
}

/// Whether an earlier scene's row of the filter has that pass, which is listed once.
static bool is_listed(const report *report, size_t scene, const char *filter, const char *pass) {
    for (size_t i = 0; i < scene; ++i) {
        const char *name = report->results->scenes[i].name;
        if (is_measured(find_pass(sweep_results_default(report->results, name, filter), pass)))
            return true;
    }
    return false;
}

static void write_filter(const report *report, size_t filter) {
    const char *name = report->filters[filter];
    for (size_t scene = 0; scene < report->results->scene_count; ++scene) {
        const sweep_row *row =
            sweep_results_default(report->results, report->results->scenes[scene].name, name);
        for (size_t i = 0; row && i < row->pass_count; ++i) {
            const sweep_pass *pass = &row->passes[i];
            if (is_measured(pass) && !is_listed(report, scene, name, pass->name))
                write_row(report, filter, pass->name);
        }
    }
}

void report_write_bandwidths(const report *report) {
    fputs("<section id=\"bandwidth\"><h2>Bandwidth of building</h2>\n", report->page);
    report_table_begin(
        report->page,
        "Passes that build maps: the bytes that each must read and write over its time, beside a "
        "plain device copy of as many bytes in the same run, from the slowest to the fastest "
        "scene. The last column is the geometric mean of their ratio.",
        "<tr><th class=\"text\" scope=\"col\">filter</th><th class=\"text\" scope=\"col\">pass</th>"
        "<th scope=\"col\">scenes</th><th scope=\"col\">GB/s</th>"
        "<th scope=\"col\">copy, GB/s</th><th scope=\"col\">pass / copy</th></tr>");
    for (size_t i = 0; i < report->filter_count; ++i)
        write_filter(report, i);
    report_table_end(report->page);
    fputs("</section>\n", report->page);
}
