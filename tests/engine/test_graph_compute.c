#include "tests/engine/cmocka_all.h"

#include <string.h>

#include "tests/engine/graph_support.h"

static void compute_fills_a_buffer(void **state) {
    graph_fixture *fixture = *state;
    size_t size = 0;
    lobe_graph_begin(fixture->graph);
    lobe_resource numbers = graph_fixture_buffer(fixture, "numbers", 1000 * sizeof(float));
    numbers = graph_fixture_count(fixture, "count", numbers, 3.0f, 1000);
    lobe_graph_read_back(fixture->graph, numbers, (lobe_range){0});
    graph_fixture_execute(fixture);
    const float *data = lobe_graph_data(fixture->graph, numbers, &size);
    assert_non_null(data);
    assert_int_equal(size, 1000 * sizeof(float));
    for (int n = 0; n < 1000; n++)
        assert_true(data[n] == 3.0f * (float)n);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(compute_fills_a_buffer, graph_fixture_open,
                                        graph_fixture_close),
    };
    return cmocka_run_group_tests_name("graph_compute", tests, NULL, NULL);
}
