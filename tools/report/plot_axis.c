#include "tools/report/plot_axis.h"

#include <math.h>
#include <stdio.h>

enum { WANTED_TICKS = 5 };

/// Heckbert 1990, "Nice Numbers for Graph Labels", Graphics Gems: 1, 2 and 5 times powers of ten.
double plot_nice_number(double value) {
    double power = pow(10, floor(log10(value)));
    const double multiples[] = {1, 2, 5, 10};
    for (size_t i = 0; i < 3; ++i) {
        // A hair of room for values that are nice but for rounding.
        if (value <= multiples[i] * power * (1 + 1e-9))
            return multiples[i] * power;
    }
    return 10 * power;
}

static void add_tick(plot_axis *axis, double value) {
    if (axis->tick_count < PLOT_MAXIMUM_TICKS)
        axis->ticks[axis->tick_count++] = value;
}

plot_axis plot_axis_linear(double maximum) {
    double step = plot_nice_number((maximum > 0 ? maximum : 1) / WANTED_TICKS);
    double steps = fmax(ceil(maximum / step - 1e-9), 1);
    plot_axis axis = {.minimum = 0, .maximum = steps * step};
    for (double i = 0; i <= steps; ++i)
        add_tick(&axis, i * step);
    return axis;
}

/// As many multiples of each power of ten as keep the ticks apart: all of 1, 2 and 5, 1 and 3, or
/// 1 alone.
static void add_logarithmic_ticks(plot_axis *axis) {
    static const double multiples[3][3] = {{1, 2, 5}, {1, 3, 0}, {1, 0, 0}};
    double decades = log10(axis->maximum / axis->minimum);
    const double *chosen = multiples[decades < 2.2 ? 0 : decades < 4 ? 1 : 2];
    double last = floor(log10(axis->maximum));
    for (double power = floor(log10(axis->minimum)); power <= last; ++power) {
        for (size_t i = 0; i < 3 && chosen[i] > 0; ++i) {
            double tick = chosen[i] * pow(10, power);
            if (tick >= axis->minimum && tick <= axis->maximum)
                add_tick(axis, tick);
        }
    }
}

/// With room at both ends, so that no mark is cut.
static plot_axis fit_logarithmic(double least, double most) {
    double room = pow(most / least, 0.06);
    plot_axis axis = {.minimum = least / room, .maximum = most * room, .logarithmic = true};
    add_logarithmic_ticks(&axis);
    return axis;
}

plot_axis plot_axis_fit(const double *values, size_t count) {
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < count; ++i) {
        if (isfinite(values[i]) && values[i] >= 0) {
            least = fmin(least, values[i]);
            most = fmax(most, values[i]);
        }
    }
    if (least > 0 && most > 10 * least)
        return fit_logarithmic(least, most);
    plot_axis axis = plot_axis_linear(most * 1.04);
    if (least == 0)
        axis.minimum = -0.05 * axis.maximum;
    return axis;
}

double plot_axis_position(const plot_axis *axis, double value) {
    if (axis->logarithmic)
        return log(value / axis->minimum) / log(axis->maximum / axis->minimum);
    return (value - axis->minimum) / (axis->maximum - axis->minimum);
}

number_text plot_axis_label(double tick) {
    number_text label;
    snprintf(label.text, sizeof label.text, fabs(tick) < 1e6 ? "%.6g" : "%.0f", tick);
    return label;
}
