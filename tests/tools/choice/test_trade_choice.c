#include "tests/engine/support/cmocka_all.h"

#include <math.h>

#include "tools/choice/trade_choice.h"

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

/// A row with its costs: rebuilding takes half of the time.
static sweep_row row_of(double milliseconds, double error) {
    return (sweep_row){
        .rebuilt_ms = milliseconds,
        .retained_ms = milliseconds / 2,
        .building_ms = milliseconds / 2,
        .shading_ms = milliseconds / 2,
        .error = {.relative_l2 = error},
    };
}

static const trade_request within_10_ms = {TRADE_LIMIT_MILLISECONDS, 10, false, 1};
static const trade_request errs_by_a_tenth = {TRADE_LIMIT_ERROR, 0.1, false, 1};

#define ROWS 8
static sweep_row rows[ROWS];
static const sweep_row *const listed[ROWS] = {&rows[0], &rows[1], &rows[2], &rows[3],
                                              &rows[4], &rows[5], &rows[6], &rows[7]};

/// Chooses among the first `count` rows.
static trade_choice choose(const trade_request *request, size_t count) {
    return trade_choose(request, listed, count);
}

static void assert_choice(const trade_choice *choice, const sweep_row *picked,
                          const sweep_row *nearest, const sweep_row *better) {
    assert_ptr_equal(choice->picked, picked);
    assert_ptr_equal(choice->nearest, nearest);
    assert_ptr_equal(choice->better, better);
}

/// Five rows on the Pareto front and one behind it.
static void make_front(void) {
    const double costs[][2] = {{1, 0.8}, {5, 0.4}, {9, 0.2}, {8, 0.5}, {12, 0.1}, {30, 0.05}};
    for (size_t i = 0; i < COUNT_OF(costs); i++)
        rows[i] = row_of(costs[i][0], costs[i][1]);
}

static void a_budget_takes_the_least_error(void **state) {
    (void)state;
    make_front();
    const trade_choice choice = choose(&within_10_ms, 6);
    assert_choice(&choice, &rows[2], &rows[0], &rows[4]);
    assert_int_equal(choice.candidates, 6);
    assert_int_equal(choice.within, 4);
}

static void an_error_takes_the_least_time(void **state) {
    (void)state;
    make_front();
    const trade_choice choice = choose(&errs_by_a_tenth, 6);
    // Among all faster rows, row 2 has the least error.
    assert_choice(&choice, &rows[4], &rows[5], &rows[2]);
    assert_int_equal(choice.candidates, 6);
    assert_int_equal(choice.within, 2);
}

static void limits_are_included(void **state) {
    (void)state;
    rows[0] = row_of(10, 0.1);
    assert_ptr_equal(choose(&within_10_ms, 1).picked, &rows[0]);
    assert_ptr_equal(choose(&errs_by_a_tenth, 1).picked, &rows[0]);
}

static void nothing_is_better_than_the_best(void **state) {
    (void)state;
    make_front();
    const trade_request plenty = {TRADE_LIMIT_MILLISECONDS, 1000, false, 1};
    trade_choice choice = choose(&plenty, 6);
    assert_choice(&choice, &rows[5], &rows[0], NULL);
    const trade_request anything = {TRADE_LIMIT_ERROR, 10, false, 1};
    choice = choose(&anything, 6);
    assert_choice(&choice, &rows[0], &rows[5], NULL);
}

static void nothing_fits(void **state) {
    (void)state;
    rows[0] = row_of(20, 0.5);
    rows[1] = row_of(15, 0.7);
    rows[2] = row_of(40, 0.2);
    trade_choice choice = choose(&within_10_ms, 3);
    assert_choice(&choice, NULL, &rows[1], NULL);
    assert_int_equal(choice.within, 0);
    choice = choose(&errs_by_a_tenth, 3);
    assert_choice(&choice, NULL, &rows[2], NULL);
    assert_int_equal(choice.candidates, 3);
}

static void of_equal_errors_the_faster_is_picked(void **state) {
    (void)state;
    rows[0] = row_of(9, 0.3);
    rows[1] = row_of(4, 0.3);
    rows[2] = row_of(6, 0.3);
    const trade_choice choice = choose(&within_10_ms, 3);
    assert_choice(&choice, &rows[1], &rows[1], NULL);
}

static void of_equal_times_the_more_exact_is_picked(void **state) {
    (void)state;
    rows[0] = row_of(4, 0.09);
    rows[1] = row_of(4, 0.05);
    rows[2] = row_of(4, 0.07);
    const trade_choice choice = choose(&errs_by_a_tenth, 3);
    assert_choice(&choice, &rows[1], &rows[1], NULL);
}

static void of_equal_rows_the_first_is_picked(void **state) {
    (void)state;
    for (size_t i = 0; i < 3; i++)
        rows[i] = row_of(4, 0.05);
    trade_choice choice = choose(&within_10_ms, 3);
    assert_choice(&choice, &rows[0], &rows[0], NULL);
    choice = choose(&errs_by_a_tenth, 3);
    assert_choice(&choice, &rows[0], &rows[0], NULL);
}

static void rows_without_time_or_error_are_passed_over(void **state) {
    (void)state;
    rows[0] = row_of(NAN, 0.01);
    rows[1] = row_of(0, 0.01);
    rows[2] = row_of(1, NAN);
    rows[3] = row_of(1, INFINITY);
    rows[4] = row_of(INFINITY, 0.01);
    rows[5] = row_of(1, -1);
    rows[6] = row_of(7, 0.09);
    for (int kind = 0; kind < 2; kind++) {
        const trade_request *request = kind == 0 ? &within_10_ms : &errs_by_a_tenth;
        trade_choice choice = choose(request, 7);
        assert_choice(&choice, &rows[6], &rows[6], NULL);
        assert_int_equal(choice.candidates, 1);
        choice = choose(request, 6);
        assert_choice(&choice, NULL, NULL, NULL);
        assert_int_equal(choice.candidates, 0);
    }
    rows[0] = row_of(1, 0); // an error of 0 is a known error
    assert_ptr_equal(choose(&errs_by_a_tenth, 1).picked, &rows[0]);
}

static void no_rows_no_choice(void **state) {
    (void)state;
    const trade_choice choice = trade_choose(&within_10_ms, NULL, 0);
    assert_choice(&choice, NULL, NULL, NULL);
}

static void retained_maps_are_not_paid_for(void **state) {
    (void)state;
    rows[0] = row_of(18, 0.05);
    rows[1] = row_of(9, 0.2);
    assert_ptr_equal(choose(&within_10_ms, 2).picked, &rows[1]);
    trade_request request = within_10_ms;
    request.retained = true;
    assert_ptr_equal(choose(&request, 2).picked, &rows[0]);
    assert_true(trade_milliseconds(&request, &rows[0]) == 9);
}

/// Building takes three quarters of the time, so four times the pixels cost 30 ms more.
static void shading_grows_with_the_pixels(void **state) {
    (void)state;
    const sweep_row row = {
        .rebuilt_ms = 40, .retained_ms = 11, .building_ms = 30, .shading_ms = 10};
    trade_request request = {.kind = TRADE_LIMIT_MILLISECONDS, .pixels = 4};
    assert_true(trade_milliseconds(&request, &row) == 70);
    request.pixels = 0.5;
    assert_true(trade_milliseconds(&request, &row) == 35);
    request.retained = true;
    assert_true(trade_milliseconds(&request, &row) == 5.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_budget_takes_the_least_error),
        cmocka_unit_test(an_error_takes_the_least_time),
        cmocka_unit_test(limits_are_included),
        cmocka_unit_test(nothing_is_better_than_the_best),
        cmocka_unit_test(nothing_fits),
        cmocka_unit_test(of_equal_errors_the_faster_is_picked),
        cmocka_unit_test(of_equal_times_the_more_exact_is_picked),
        cmocka_unit_test(of_equal_rows_the_first_is_picked),
        cmocka_unit_test(rows_without_time_or_error_are_passed_over),
        cmocka_unit_test(no_rows_no_choice),
        cmocka_unit_test(retained_maps_are_not_paid_for),
        cmocka_unit_test(shading_grows_with_the_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
