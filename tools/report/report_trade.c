#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/report/html.h"
#include "tools/report/plot_scatter.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"
#include "tools/report/report_rows.h"

/// Error over what it costs: a plot of all rows of a scene.
typedef struct trade {
    const char *id, *title, *x_title, *unit;
    report_measure *cost;
} trade;

static const trade trades[] = {
    {"rebuilt", "Time and error, maps rebuilt", "milliseconds a frame, maps rebuilt", "ms",
     report_rebuilt},
    {"retained", "Time and error, maps retained", "milliseconds a frame, maps retained", "ms",
     report_retained},
    {"memory", "Memory and error", "bytes a texel of filtered maps", "bytes a texel", report_bytes},
};

typedef char row_name[160];

/// The rows of a scene, as points know them.
typedef struct trade_rows {
    const sweep_row **rows;
    row_name *names;
    plot_point *points;
    size_t *front;
    size_t count;
} trade_rows;

static size_t filter_index(const report *report, const char *name) {
    size_t index = 0;
    while (strcmp(report->filters[index], name) != 0)
        ++index;
    return index;
}

/// The row whose knobs are all at their defaults; itself where there is none.
static size_t find_origin(const trade_rows *rows, size_t index) {
    for (size_t i = 0; i < rows->count; ++i) {
        if (rows->rows[i]->varied[0] == '\0' &&
            strcmp(rows->rows[i]->filter, rows->rows[index]->filter) == 0)
            return i;
    }
    return index;
}

static void name_row(const sweep_row *row, row_name name) {
    const char *value = report_varied_value(row);
    if (value)
        snprintf(name, sizeof(row_name), "%s, %s %s", row->filter, row->varied, value);
    else
        snprintf(name, sizeof(row_name), "%s", row->filter);
}

static void collect(const report *report, const char *scene, trade_rows *rows) {
    for (size_t i = 0; i < report->results->row_count; ++i) {
        const sweep_row *row = &report->results->rows[i];
        if (strcmp(row->scene, scene) == 0 && !report_is_far(row->filter)) {
            name_row(row, rows->names[rows->count]);
            rows->rows[rows->count++] = row;
        }
    }
    for (size_t i = 0; i < rows->count; ++i)
        rows->points[i] = (plot_point){.series = filter_index(report, rows->rows[i]->filter),
                                       .origin = find_origin(rows, i),
                                       .about = rows->names[i],
                                       .kind = report_method(rows->rows[i])};
}

static void write_front(const report *report, const trade *trade, const trade_rows *rows,
                        size_t count) {
    fputs("<ol class=\"front\">", report->page);
    for (size_t i = 0; i < count; ++i) {
        const plot_point *point = &rows->points[rows->front[i]];
        fputs("<li>", report->page);
        html_text(report->page, point->about);
        fputs(": ", report->page);
        report_number(report->page, point->x, 3);
        fprintf(report->page, " %s, ", trade->unit);
        report_number(report->page, point->y, 3);
        fputs("</li>", report->page);
    }
    fputs("</ol>", report->page);
}

static void write_far(const report *report, size_t scene, const trade *trade) {
    const char *name = report->results->scenes[scene].name;
    for (size_t i = 0; i < report->filter_count; ++i) {
        const sweep_row *row = sweep_results_default(report->results, name, report->filters[i]);
        if (!row || !report_is_far(row->filter))
            continue;
        fputs("Not drawn: ", report->page);
        html_text(report->page, row->filter);
        fputs(", ", report->page);
        report_number(report->page, trade->cost(row), 3);
        fprintf(report->page, " %s, error ", trade->unit);
        report_number(report->page, report_error(row), 3);
    }
}

static void write_trade(const report *report, size_t scene, const trade *trade,
                        const trade_rows *rows) {
    char id[48];
    snprintf(id, sizeof id, "scene-%zu-%s", scene, trade->id);
    const bool lit = report->results->scenes[scene].environment != NULL;
    const plot_scatter plot = {.id = id,
                               .title = trade->title,
                               .x_title = trade->x_title,
                               .y_title = "error, relative L2",
                               .series = report->filters,
                               .series_count = report->filter_count,
                               .points = rows->points,
                               .point_count = rows->count,
                               .kinds = report_methods,
                               .kind_count = lit ? REPORT_METHODS : 0};
    for (size_t i = 0; i < rows->count; ++i) {
        rows->points[i].x = trade->cost(rows->rows[i]);
        rows->points[i].y = report_error(rows->rows[i]);
    }
    fprintf(report->page, "<figure><h4>%s</h4>\n", trade->title);
    size_t count = plot_scatter_draw(report->page, &plot, rows->front);
    if (count > 0) {
        fputs("<figcaption>Pareto front, with cost and error:", report->page);
        write_front(report, trade, rows, count);
        write_far(report, scene, trade);
        fputs("</figcaption>", report->page);
    } else {
        fputs("<p>Nothing was measured.</p>", report->page);
    }
    fputs("</figure>\n", report->page);
}

static bool allocate(trade_rows *rows, size_t count) {
    *rows = (trade_rows){
        .rows = calloc(count + 1, sizeof *rows->rows),
        .names = calloc(count + 1, sizeof *rows->names),
        .points = calloc(count + 1, sizeof *rows->points),
        .front = calloc(count + 1, sizeof *rows->front),
    };
    return rows->rows && rows->names && rows->points && rows->front;
}

lobe_result report_write_trade(const report *report, size_t scene) {
    const char *name = report->results->scenes[scene].name;
    size_t count = report_count_rows(report->results, name);
    if (count > PLOT_MAXIMUM_POINTS)
        return lobe_host_fail(report->host, LOBE_ERROR_LIMIT,
                              "%s: scene '%s' has %zu rows, a plot shows at most %d", report->path,
                              name, count, PLOT_MAXIMUM_POINTS);
    trade_rows rows;
    lobe_result result = LOBE_OK;
    if (allocate(&rows, count)) {
        collect(report, name, &rows);
        for (size_t i = 0; i < sizeof trades / sizeof *trades; ++i)
            write_trade(report, scene, &trades[i], &rows);
    } else {
        result = lobe_host_fail(report->host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory",
                                report->path);
    }
    free(rows.rows);
    free(rows.names);
    free(rows.points);
    free(rows.front);
    return result;
}
