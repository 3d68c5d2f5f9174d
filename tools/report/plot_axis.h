#ifndef TOOLS_REPORT_PLOT_AXIS_H
#define TOOLS_REPORT_PLOT_AXIS_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/cli/number_text.h"

/// A plot's axis: which values it spans, on what scale, and where its ticks are.

#define PLOT_MAXIMUM_TICKS 32

typedef struct plot_axis {
    double minimum, maximum; ///< minimum < maximum
    bool logarithmic;
    double ticks[PLOT_MAXIMUM_TICKS]; ///< rising, within the span
    size_t tick_count;                ///< at least 2
} plot_axis;

/// An axis for values that are not negative (others, and what is not finite, are passed over). It
/// is logarithmic where all are positive and they span more than a decade; else it begins at 0,
/// or, where a value is 0, a little before, so that its mark is not upon the edge.
plot_axis plot_axis_fit(const double *values, size_t count);

/// A linear axis from 0; its last tick is not below `maximum`.
plot_axis plot_axis_linear(double maximum);

/// 0 at the minimum, 1 at the maximum.
double plot_axis_position(const plot_axis *axis, double value);

number_text plot_axis_label(double tick);

/// The least 1, 2 or 5 times a power of ten that is not below `value` > 0.
double plot_nice_number(double value);

#endif
