#include "tools/report/html.h"
#include "tools/report/report.h"

/// The policy lets a browser fetch nothing, whatever the page may hold.
static const char opening[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<link rel=\"icon\" href=\"data:,\">\n"
    "<title>What filtering appearance costs, and how wrong it is</title>\n";

static lobe_result write_measured(const report *report, size_t scene) {
    lobe_result result = report_write_pictures(report, scene);
    if (result != LOBE_OK)
        return result;
    fputs("<h3>Time, memory and error</h3>\n<div class=\"plots\">\n", report->page);
    result = report_write_trade(report, scene);
    if (result == LOBE_OK)
        result = report_write_pass_bars(report, scene);
    fputs("</div>\n", report->page);
    report_write_methods(report, scene);
    report_write_numbers(report, scene);
    report_write_variations(report, scene);
    report_write_passes(report, scene);
    return result;
}

static lobe_result write_scene(const report *report, size_t index) {
    const sweep_scene *scene = &report->results->scenes[index];
    lobe_result result = LOBE_OK;
    fprintf(report->page, "<section class=\"scene\" id=\"scene-%zu\"><h2>Scene ", index);
    html_text(report->page, scene->name);
    fputs("</h2>\n", report->page);
    if (scene->skipped) {
        fputs("<p class=\"notice\">Not measured: ", report->page);
        html_text(report->page, scene->skipped);
        fputs("</p>\n", report->page);
    } else {
        fprintf(report->page, "<p>%llu triangles.</p>\n", (unsigned long long)scene->triangles);
        report_write_light(report, index);
        result = write_measured(report, index);
    }
    fputs("</section>\n", report->page);
    return result;
}

lobe_result report_write_page(const report *report) {
    fputs(opening, report->page);
    report_write_style(report);
    fputs("</head>\n<body>\n", report->page);
    report_write_head(report);
    fputs("<main>\n", report->page);
    report_write_summary(report);
    report_write_targets(report);
    report_write_paper(report);
    report_write_bandwidths(report);
    report_write_guide(report);
    fputs("<div id=\"scenes\">\n", report->page);
    lobe_result result = LOBE_OK;
    for (size_t i = 0; result == LOBE_OK && i < report->results->scene_count; ++i)
        result = write_scene(report, i);
    fputs("</div>\n</main>\n</body>\n</html>\n", report->page);
    return result;
}
