#include "tools/report/report_measure.h"

#include <math.h>

double report_error(const sweep_row *row) {
    return row->error.relative_l2;
}

double report_flicker(const sweep_row *row) {
    return row->flicker < 0 ? NAN : row->flicker;
}

double report_rebuilt(const sweep_row *row) {
    return row->rebuilt_ms;
}

double report_retained(const sweep_row *row) {
    return row->retained_ms;
}

double report_bytes(const sweep_row *row) {
    return row->bytes_per_texel;
}

static double measure_default(const report *report, report_measure *measure, const char *scene,
                              const char *filter) {
    const sweep_row *row = sweep_results_default(report->results, scene, filter);
    return row ? measure(row) : NAN;
}

double report_ratio(const report *report, report_measure *measure, const char *scene,
                    const char *filter, const char *base) {
    double value = measure_default(report, measure, scene, filter);
    return base ? value / measure_default(report, measure, scene, base) : value;
}

report_mean report_mean_ratio(const report *report, report_measure *measure, const char *filter,
                              const char *base) {
    double sum = 0, logarithms = 0;
    report_mean mean = {.scenes = 0};
    for (size_t i = 0; i < report->results->scene_count; ++i) {
        double ratio = report_ratio(report, measure, report->results->scenes[i].name, filter, base);
        if (!isfinite(ratio))
            continue;
        sum += ratio;
        logarithms += log(ratio);
        ++mean.scenes;
    }
    mean.arithmetic = mean.scenes ? sum / (double)mean.scenes : NAN;
    mean.geometric = mean.scenes ? exp(logarithms / (double)mean.scenes) : NAN;
    return mean;
}

double report_ratio_of_means(const report *report, report_measure *measure, const char *filter,
                             const char *base) {
    double sum = 0, base_sum = 0;
    for (size_t i = 0; i < report->results->scene_count; ++i) {
        const char *scene = report->results->scenes[i].name;
        double value = measure_default(report, measure, scene, filter);
        double base_value = measure_default(report, measure, scene, base);
        if (isfinite(value) && isfinite(base_value)) {
            sum += value;
            base_sum += base_value;
        }
    }
    return base_sum > 0 ? sum / base_sum : NAN;
}
