#include <string.h>

#include "tools/report/html.h"
#include "tools/report/report.h"

static void write_fact(FILE *page, const char *name, const char *text) {
    fprintf(page, "<div><dt>%s</dt><dd>", name);
    html_text(page, text);
    fputs("</dd></div>\n", page);
}

static size_t measured_scenes(const sweep_results *results) {
    size_t count = 0;
    for (size_t i = 0; i < results->scene_count; ++i)
        count += results->scenes[i].skipped == NULL;
    return count;
}

static void write_scenes(const report *report) {
    const sweep_results *results = report->results;
    fputs("<div><dt>scenes</dt><dd>", report->page);
    for (size_t i = 0; i < results->scene_count; ++i) {
        fprintf(report->page, "%s<a href=\"#scene-%zu\">", i > 0 ? ", " : "", i);
        html_text(report->page, results->scenes[i].name);
        fprintf(report->page, "</a>%s", results->scenes[i].skipped ? " (not measured)" : "");
    }
    fputs("</dd></div>\n", report->page);
}

static void write_facts(const report *report) {
    const sweep_results *results = report->results;
    char text[160], date[64];
    struct tm utc;
    gmtime_r(&report->time, &utc);
    strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &utc);
    fputs("<dl class=\"facts\">\n", report->page);
    write_fact(report->page, "measured", date);
    write_fact(report->page, "lobe", results->version);
    write_fact(report->page, "device", results->device);
    write_fact(report->page, "type", results->device_type);
    write_fact(report->page, "driver", results->driver);
    snprintf(text, sizeof text, "%u × %u pixels", results->size[0], results->size[1]);
    write_fact(report->page, "size", text);
    snprintf(text, sizeof text, "%u a pixel (still), twice %u (path)", results->reference_samples,
             results->path_samples);
    write_fact(report->page, "reference samples", text);
    snprintf(text, sizeof text, "%u of each row", results->frames);
    write_fact(report->page, "frames timed", text);
    write_scenes(report);
    fputs("</dl>\n", report->page);
}

static void write_notices(const report *report) {
    const sweep_results *results = report->results;
    if (!results->complete)
        fputs("<p class=\"notice\">The measurement was interrupted: some rows are missing.</p>\n",
              report->page);
    if (strcmp(results->device_type, "CPU") == 0)
        fputs("<p class=\"notice\">Times are those of a software renderer: they compare filters "
              "with each other, not with a GPU.</p>\n",
              report->page);
}

void report_write_head(const report *report) {
    const sweep_results *results = report->results;
    fprintf(report->page,
            "<header><h1>What filtering appearance costs, and how wrong it is</h1>\n"
            "<p>%zu filters of normal and BRDF maps in %zu scenes: time, memory, error and "
            "flicker, measured in one run.</p>\n",
            report->filter_count, measured_scenes(results));
    write_notices(report);
    write_facts(report);
    fputs("<nav aria-label=\"Sections\"><a href=\"#summary\">Summary</a> "
          "<a href=\"#targets\">Targets</a> <a href=\"#paper\">Beside the paper’s table</a> "
          "<a href=\"#bandwidth\">Bandwidth</a> <a href=\"#guide\">How to read this</a> "
          "<a href=\"#scenes\">Scenes</a></nav></header>\n",
          report->page);
}
