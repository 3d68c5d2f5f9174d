#ifndef TOOLS_REPORT_REPORT_MEASURE_H
#define TOOLS_REPORT_REPORT_MEASURE_H

#include "tools/report/report.h"

/// Numbers of rows, and their means over scenes.

/// A number of a row; NaN where it was not measured.
typedef double report_measure(const sweep_row *row);

double report_error(const sweep_row *row); ///< relative L2
double report_flicker(const sweep_row *row);
double report_rebuilt(const sweep_row *row);  ///< milliseconds of a frame, all maps rebuilt
double report_retained(const sweep_row *row); ///< milliseconds, no map built
double report_bytes(const sweep_row *row);    ///< a texel

/// A filter's measure, at its defaults in a scene, over that of another filter; NULL: the measure
/// itself. NaN where a row is missing.
double report_ratio(const report *report, report_measure *measure, const char *scene,
                    const char *filter, const char *base);

typedef struct report_mean {
    double arithmetic, geometric; ///< NaN without scenes
    size_t scenes;                ///< those that have a value
} report_mean;

/// Mean of report_ratio over the scenes.
report_mean report_mean_ratio(const report *report, report_measure *measure, const char *filter,
                              const char *base);

/// Mean over the scenes that have both, over the other filter's mean over them.
double report_ratio_of_means(const report *report, report_measure *measure, const char *filter,
                             const char *base);

#endif
