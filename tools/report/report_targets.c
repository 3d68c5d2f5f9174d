#include <math.h>
#include <string.h>

#include "tools/cli/number_text.h"
#include "tools/report/report_cells.h"
#include "tools/report/report_measure.h"

/// What the filter `moments` sets out to reach: a ratio of two filters' measures.
typedef struct target {
    const char *name;
    report_measure *measure;
    const char *scene; ///< NULL: the means over all scenes that have both filters
    const char *filter, *base;
    double limit;
    bool at_least; ///< else at most
} target;

/// Times with all maps rebuilt: no more than the paper's own method takes relative to direct
/// sampling. Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", table 1.
static const target targets[] = {
    {"error(moments) / error(lobes)", report_error, NULL, "moments", "lobes", 0.5, false},
    {"bytes(moments) / bytes(lobes)", report_bytes, NULL, "moments", "lobes", 1, false},
    {"error(moments) / error(lean)", report_error, NULL, "moments", "lean", 0.5, false},
    {"flicker(moments) / flicker(lobes)", report_flicker, NULL, "moments", "lobes", 0.3, false},
    {"error(moments) / error(lobes)", report_error, "checkerboard", "moments", "lobes", 0.2, false},
    {"time(moments) / time(direct)", report_rebuilt, "pillow", "moments", "direct", 3.3, false},
    {"time(moments) / time(direct)", report_rebuilt, "tablecloth", "moments", "direct", 4, false},
    {"time(moments) / time(direct)", report_rebuilt, "bunny", "moments", "direct", 3.6, false},
    {"time(moments) / time(direct)", report_rebuilt, "dragon", "moments", "direct", 3.4, false},
    {"time(moments) / time(direct)", report_rebuilt, "hall", "moments", "direct", 1.6, false},
    {"time(reference) / time(moments)", report_rebuilt, "pillow", "reference", "moments", 40, true},
    {"time(reference) / time(moments)", report_rebuilt, "tablecloth", "reference", "moments", 40,
     true},
    {"time(reference) / time(moments)", report_rebuilt, "bunny", "reference", "moments", 40, true},
    {"time(reference) / time(moments)", report_rebuilt, "dragon", "reference", "moments", 40, true},
    {"time(reference) / time(moments)", report_rebuilt, "hall", "reference", "moments", 40, true},
};

static bool has_filter(const report *report, const char *filter) {
    for (size_t i = 0; i < report->filter_count; ++i) {
        if (strcmp(report->filters[i], filter) == 0)
            return true;
    }
    return false;
}

/// Why a target has no value.
static void write_absence(const report *report, const target *target) {
    const char *filters[] = {target->filter, target->base};
    fputs("<td class=\"text\" colspan=\"3\">", report->page);
    for (size_t i = 0; i < 2; ++i) {
        if (!has_filter(report, filters[i])) {
            fprintf(report->page, "the filter %s is not in the results</td>", filters[i]);
            return;
        }
    }
    if (target->scene)
        fprintf(report->page, "the scene %s was not measured with both filters</td>",
                target->scene);
    else
        fputs("no scene was measured with both filters</td>", report->page);
}

static void write_value(const report *report, const target *target, double value) {
    FILE *page = report->page;
    bool met = target->at_least ? value >= target->limit : value <= target->limit;
    report_number_cell(page, value, 3);
    double by = target->at_least ? target->limit / value : value / target->limit;
    if (met)
        fputs("<td class=\"text met\">✓ met</td>", page);
    else
        fprintf(page, "<td class=\"text missed\">✗ missed by %s %%</td>",
                number_text_of(100 * (by - 1), 2).text);
    if (target->scene) {
        fputs("<td class=\"text\"></td>", page);
        return;
    }
    report_mean mean = report_mean_ratio(report, target->measure, target->filter, target->base);
    fprintf(page, "<td class=\"text\">%s, geometric %s</td>",
            number_text_of(mean.arithmetic, 3).text, number_text_of(mean.geometric, 3).text);
}

static void write_scene(const report *report, const target *target) {
    size_t scenes = report_mean_ratio(report, target->measure, target->filter, target->base).scenes;
    if (target->scene)
        report_text_cell(report->page, target->scene);
    else
        fprintf(report->page, "<td class=\"text\">means over %zu scene%s</td>", scenes,
                scenes == 1 ? "" : "s");
}

static void write_target(const report *report, const target *target) {
    double value =
        target->scene
            ? report_ratio(report, target->measure, target->scene, target->filter, target->base)
            : report_ratio_of_means(report, target->measure, target->filter, target->base);
    fputs("<tr>", report->page);
    report_head_cell(report->page, target->name);
    write_scene(report, target);
    fprintf(report->page, "<td>%s %g</td>", target->at_least ? "≥" : "≤", target->limit);
    if (isfinite(value))
        write_value(report, target, value);
    else
        write_absence(report, target);
    fputs("</tr>\n", report->page);
}

void report_write_targets(const report *report) {
    fputs("<section id=\"targets\"><h2>Targets</h2>\n", report->page);
    report_table_begin(
        report->page,
        "What the filter moments is to reach. Times are of frames in which every "
        "map is built again; reference takes 64 samples a pixel.",
        "<tr><th class=\"text\" scope=\"col\">ratio</th><th class=\"text\" scope=\"col\">scene</th>"
        "<th scope=\"col\">target</th><th scope=\"col\">value</th>"
        "<th class=\"text\" scope=\"col\">result</th>"
        "<th class=\"text\" scope=\"col\">mean of the scenes’ ratios</th></tr>");
    for (size_t i = 0; i < sizeof targets / sizeof *targets; ++i)
        write_target(report, &targets[i]);
    report_table_end(report->page);
    fputs("</section>\n", report->page);
}
