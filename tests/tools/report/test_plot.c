#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/number_text.h"
#include "tools/report/html.h"
#include "tools/report/plot_axis.h"
#include "tools/report/plot_bars.h"
#include "tools/report/plot_labels.h"
#include "tools/report/plot_pareto.h"
#include "tools/report/plot_scatter.h"
#include "tools/report/plot_style.h"

// ---------------------------------------------------------------------------------------------
// Text

static void expect_escaped(const char *text, const char *expected) {
    char written[256] = "";
    FILE *page = fmemopen(written, sizeof written, "w");
    assert_non_null(page);
    html_text(page, text);
    fclose(page);
    assert_string_equal(written, expected);
}

static void text_is_escaped(void **state) {
    (void)state;
    expect_escaped("<a href=\"x\">'&amp;'</a>",
                   "&lt;a href=&quot;x&quot;&gt;&#39;&amp;amp;&#39;&lt;/a&gt;");
    expect_escaped("plain ε₀ – 漢 😀", "plain ε₀ – 漢 😀");
    expect_escaped("a\tb\nc", "a\tb\nc");
}

static void what_html_may_not_hold_is_replaced(void **state) {
    (void)state;
    expect_escaped("a\x01z\x7f", "a\xef\xbf\xbdz\xef\xbf\xbd");
    expect_escaped("\xff", "\xef\xbf\xbd");
    expect_escaped("\xc3", "\xef\xbf\xbd");                 // cut off
    expect_escaped("\xc0\xbc", "\xef\xbf\xbd\xef\xbf\xbd"); // an overlong <
    expect_escaped("\xc2\x85", "\xef\xbf\xbd\xef\xbf\xbd"); // a control character
    expect_escaped("\xed\xa0\x80<", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd&lt;"); // a surrogate
    expect_escaped("\xf4\x90\x80\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
    expect_escaped("\xe2\x82<", "\xef\xbf\xbd\xef\xbf\xbd&lt;");
}

/// The examples of RFC 4648, section 10.
static void data_is_in_base64(void **state) {
    (void)state;
    const char *const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (size_t size = 0; size <= 6; ++size) {
        char written[32] = "";
        FILE *page = fmemopen(written, sizeof written, "w");
        html_base64(page, (const uint8_t *)"foobar", size);
        fclose(page);
        assert_string_equal(written, expected[size]);
    }
}

static void numbers_read_well(void **state) {
    (void)state;
    assert_string_equal(number_text_of(0.0123456, 3).text, "0.0123");
    assert_string_equal(number_text_of(0.99996, 4).text, "1.000");
    assert_string_equal(number_text_of(9.996, 3).text, "10.0");
    assert_string_equal(number_text_of(14194.3, 4).text, "14194");
    assert_string_equal(number_text_of(-2.5, 2).text, "-2.5");
    assert_string_equal(number_text_of(0, 4).text, "0");
    assert_string_equal(number_text_of(NAN, 4).text, "–");
    assert_string_equal(number_text_of(INFINITY, 4).text, "∞");
    assert_string_equal(number_text_of(1e-30, 3).text, "0.000000000");
}

// ---------------------------------------------------------------------------------------------
// Axes

static void expect_ticks(const plot_axis *axis, size_t count, ...) {
    assert_int_equal(axis->tick_count, count);
    va_list ticks;
    va_start(ticks, count);
    for (size_t i = 0; i < count; ++i)
        assert_float_equal(axis->ticks[i], va_arg(ticks, double), 1e-9 * axis->maximum);
    va_end(ticks);
}

static void nice_numbers_are_not_below(void **state) {
    (void)state;
    const double pairs[][2] = {{1, 1},     {1.01, 2}, {2, 2},      {3, 5},      {5.1, 10},
                               {0.3, 0.5}, {0.7, 1},  {730, 1000}, {1e-5, 1e-5}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i)
        assert_float_equal(plot_nice_number(pairs[i][0]), pairs[i][1], 1e-9 * pairs[i][1]);
}

static void linear_axes_begin_at_zero(void **state) {
    (void)state;
    plot_axis axis = plot_axis_fit((const double[]){40, 18, 45, NAN}, 4);
    assert_false(axis.logarithmic);
    expect_ticks(&axis, 6, 0., 10., 20., 30., 40., 50.);
    assert_float_equal(plot_axis_position(&axis, 25), 0.5, 1e-12);
    assert_float_equal(axis.minimum, 0, 0);
    axis = plot_axis_linear(0);
    assert_true(axis.maximum > 0 && axis.tick_count >= 2);
}

static void a_value_of_zero_is_within_the_axis(void **state) {
    (void)state;
    plot_axis axis = plot_axis_fit((const double[]){0, 8, 33}, 3);
    assert_false(axis.logarithmic);
    assert_true(axis.minimum < 0 && plot_axis_position(&axis, 0) > 0.02);
    assert_float_equal(axis.ticks[0], 0, 0);
}

static void wide_ranges_are_logarithmic(void **state) {
    (void)state;
    plot_axis axis = plot_axis_fit((const double[]){0.04, 1.9}, 2);
    assert_true(axis.logarithmic);
    expect_ticks(&axis, 6, 0.05, 0.1, 0.2, 0.5, 1., 2.);
    assert_true(axis.minimum < 0.04 && axis.maximum > 1.9);
    assert_float_equal(plot_axis_position(&axis, sqrt(axis.minimum * axis.maximum)), 0.5, 1e-12);
    axis = plot_axis_fit((const double[]){1e-3, 1e3}, 2);
    expect_ticks(&axis, 7, 1e-3, 1e-2, 0.1, 1., 10., 100., 1000.);
    axis = plot_axis_fit((const double[]){0, 1e3}, 2);
    assert_false(axis.logarithmic);
}

static void every_axis_has_ticks_within(void **state) {
    (void)state;
    for (double least = 1e-7; least < 1e7; least *= 3.7) {
        for (double factor = 1; factor < 1e12; factor *= 2.3) {
            plot_axis axis = plot_axis_fit((const double[]){least, least * factor}, 2);
            assert_true(axis.tick_count >= 2 && axis.tick_count <= PLOT_MAXIMUM_TICKS);
            for (size_t i = 0; i < axis.tick_count; ++i) {
                assert_true(axis.ticks[i] >= axis.minimum - 1e-9 * axis.maximum);
                assert_true(axis.ticks[i] <= axis.maximum * (1 + 1e-9));
                assert_true(i == 0 || axis.ticks[i] > axis.ticks[i - 1]);
            }
            double last = plot_axis_position(&axis, least * factor);
            assert_true(last > 0 && last <= 1 + 1e-9);
        }
    }
}

static void ticks_are_labelled_shortly(void **state) {
    (void)state;
    assert_string_equal(plot_axis_label(0.05).text, "0.05");
    assert_string_equal(plot_axis_label(3 * 0.2).text, "0.6");
    assert_string_equal(plot_axis_label(20000).text, "20000");
    assert_string_equal(plot_axis_label(2e6).text, "2000000");
}

// ---------------------------------------------------------------------------------------------
// Pareto front

static void the_front_is_what_no_other_beats(void **state) {
    (void)state;
    const plot_cost costs[] = {{3, 1}, {1, 5}, {2, 6},   {2, 3},       {2, 4},
                               {4, 1}, {1, 5}, {0, NAN}, {INFINITY, 0}};
    size_t front[9];
    assert_int_equal(plot_pareto_front(costs, 9, front), 3);
    assert_int_equal(front[0], 1);
    assert_int_equal(front[1], 3);
    assert_int_equal(front[2], 0);
    assert_int_equal(plot_pareto_front(costs, 0, front), 0);
    assert_int_equal(plot_pareto_front(&costs[7], 2, front), 0);
}

static bool beats(const plot_cost *a, const plot_cost *b) {
    return a->x <= b->x && a->y <= b->y && (a->x < b->x || a->y < b->y);
}

/// By its definition, over points on a coarse grid, so that many are equal in one cost or both.
static void fronts_follow_the_definition(void **state) {
    (void)state;
    uint32_t random = 1;
    for (int round = 0; round < 200; ++round) {
        plot_cost costs[24];
        size_t front[24];
        for (size_t i = 0; i < 24; ++i) {
            random = random * 1664525u + 1013904223u;
            costs[i] = (plot_cost){random >> 28, random >> 24 & 15};
        }
        size_t count = plot_pareto_front(costs, 24, front);
        for (size_t i = 0; i < 24; ++i) {
            bool beaten = false, shown = false;
            for (size_t k = 0; k < 24; ++k)
                beaten = beaten || beats(&costs[k], &costs[i]);
            for (size_t k = 0; k < count; ++k)
                shown =
                    shown || (costs[front[k]].x == costs[i].x && costs[front[k]].y == costs[i].y);
            assert_true(beaten != shown);
        }
        for (size_t k = 1; k < count; ++k)
            assert_true(costs[front[k]].x > costs[front[k - 1]].x &&
                        costs[front[k]].y < costs[front[k - 1]].y);
    }
}

// ---------------------------------------------------------------------------------------------
// Labels

static bool overlap(const plot_box *a, const plot_box *b) {
    return fmin(a->right, b->right) > fmax(a->left, b->left) + 1e-9 &&
           fmin(a->bottom, b->bottom) > fmax(a->top, b->top) + 1e-9;
}

static void labels_keep_apart(void **state) {
    (void)state;
    plot_labels labels = {.bounds = {0, 0, 500, 400}};
    plot_box boxes[8];
    for (int i = 0; i < 8; ++i) {
        // Close together, and the first in a corner.
        double x = 4 + 6 * i, y = 6 + 5 * i;
        plot_labels_take(&labels, (plot_box){x - 3, y - 3, x + 3, y + 3});
    }
    for (int i = 0; i < 8; ++i) {
        boxes[i] = plot_labels_place(&labels, 4 + 6 * i, 6 + 5 * i, "moments");
        assert_true(boxes[i].left >= 0 && boxes[i].top >= 0 && boxes[i].right <= 500);
        for (int k = 0; k < i; ++k)
            assert_false(overlap(&boxes[i], &boxes[k]));
    }
}

static void characters_count_once(void **state) {
    (void)state;
    assert_float_equal(plot_text_width("εεε"), plot_text_width("aaa"), 0);
    assert_true(plot_text_width("aaaa") > plot_text_width("aaa"));
}

// ---------------------------------------------------------------------------------------------
// Drawing

/// Without its colours, as print shows it.
static void draw_shape(size_t series, char text[512]) {
    FILE *page = fmemopen(text, 512, "w");
    plot_draw_marker(page, series, PLOT_MARKER_FULL, 10, 10, 5);
    fclose(page);
    char *colours = strstr(text, "fill=");
    assert_non_null(colours);
    *colours = '\0';
}

static void markers_differ_in_shape(void **state) {
    (void)state;
    char shapes[PLOT_SHAPES][512];
    for (size_t i = 0; i < PLOT_SHAPES; ++i) {
        draw_shape(i, shapes[i]);
        for (size_t k = 0; k < i; ++k)
            assert_string_not_equal(shapes[i], shapes[k]);
    }
    for (size_t i = 1; i < PLOT_COLOURS; ++i)
        assert_string_not_equal(plot_colour(i), plot_colour(i - 1));
}

static size_t count(const char *text, const char *part) {
    size_t found = 0;
    for (; (text = strstr(text, part)) != NULL; text += strlen(part))
        ++found;
    return found;
}

static void a_scatter_plot_draws_what_it_can_show(void **state) {
    (void)state;
    const char *const series[] = {"<first>", "second", "unused"};
    const plot_point points[] = {
        {.x = 1, .y = 9, .series = 0, .origin = 0, .about = "a & b"},
        {.x = 2, .y = 5, .series = 0, .origin = 0, .about = "c", .kind = 1},
        {.x = 3, .y = 6, .series = 1, .origin = 2, .about = "d"},
        {.x = NAN, .y = 6, .series = 1, .origin = 2, .about = "not there"},
        {.x = 3, .y = -1, .series = 1, .origin = 2, .about = "not there"},
    };
    const char *const kinds[] = {"plain", "dotted"};
    const plot_scatter plot = {"id", "title", "x", "y", series, 3, points, 5, kinds, 2};
    char *text;
    size_t size, front[5];
    FILE *page = open_memstream(&text, &size);
    assert_int_equal(plot_scatter_draw(page, &plot, front), 2);
    fclose(page);
    assert_int_equal(front[0], 0);
    assert_int_equal(front[1], 1);
    assert_int_equal(count(text, "class=\"ring\""), 2);
    assert_int_equal(count(text, "<title>"), 3);
    assert_int_equal(count(text, "a &amp; b"), 1);
    assert_int_equal(count(text, "&lt;first&gt;"), 2);
    assert_int_equal(count(text, "not there"), 0);
    assert_int_equal(count(text, "unused"), 0);
    assert_int_equal(count(text, ">plain<") + count(text, ">dotted<"), 2);
    assert_int_equal(count(text, "r=\"1.68\""), 2); // of a point and in the legend
    free(text);
}

static void nothing_to_show_draws_nothing(void **state) {
    (void)state;
    const char *const series[] = {"a"};
    const plot_point point = {.x = NAN, .y = 1, .about = ""};
    const plot_scatter plot = {"id", "title", "x", "y", series, 1, &point, 1, NULL, 0};
    char *text;
    size_t size, front[1];
    FILE *page = open_memstream(&text, &size);
    assert_int_equal(plot_scatter_draw(page, &plot, front), 0);
    fclose(page);
    assert_int_equal(size, 0);
    free(text);
}

static void bars_are_as_long_as_their_values(void **state) {
    (void)state;
    const char *const kinds[] = {"one", "two"};
    const plot_bar_part parts[] = {{0, 10}, {1, 30}, {1, 20}};
    const plot_bar bars[] = {{"a", parts, 2}, {"b", &parts[2], 1}};
    const plot_bars plot = {"id", "title", "x", kinds, 2, bars, 2};
    char *text;
    size_t size;
    FILE *page = open_memstream(&text, &size);
    plot_bars_draw(page, &plot);
    fclose(page);
    double x[3], width[3];
    const char *at = text;
    for (int i = 0; i < 3; ++i) {
        at = strstr(at, "<rect class=\"part\"");
        assert_int_equal(
            sscanf(at, "<rect class=\"part\" x=\"%lf\" y=\"%*f\" width=\"%lf\"", &x[i], &width[i]),
            2);
        ++at;
    }
    assert_float_equal(width[1], 3 * width[0], 0.02);
    assert_float_equal(width[2], 2 * width[0], 0.02);
    assert_float_equal(x[1], x[0] + width[0], 0.02);
    assert_float_equal(x[2], x[0], 0.02);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_escaped),
        cmocka_unit_test(what_html_may_not_hold_is_replaced),
        cmocka_unit_test(data_is_in_base64),
        cmocka_unit_test(numbers_read_well),
        cmocka_unit_test(nice_numbers_are_not_below),
        cmocka_unit_test(linear_axes_begin_at_zero),
        cmocka_unit_test(a_value_of_zero_is_within_the_axis),
        cmocka_unit_test(wide_ranges_are_logarithmic),
        cmocka_unit_test(every_axis_has_ticks_within),
        cmocka_unit_test(ticks_are_labelled_shortly),
        cmocka_unit_test(the_front_is_what_no_other_beats),
        cmocka_unit_test(fronts_follow_the_definition),
        cmocka_unit_test(labels_keep_apart),
        cmocka_unit_test(characters_count_once),
        cmocka_unit_test(markers_differ_in_shape),
        cmocka_unit_test(a_scatter_plot_draws_what_it_can_show),
        cmocka_unit_test(nothing_to_show_draws_nothing),
        cmocka_unit_test(bars_are_as_long_as_their_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
