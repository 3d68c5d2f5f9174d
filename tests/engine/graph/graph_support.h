#ifndef TESTS_ENGINE_GRAPH_GRAPH_SUPPORT_H
#define TESTS_ENGINE_GRAPH_GRAPH_SUPPORT_H

#include <lobe/graph.h>
#include <lobe/vulkan.h>

#include "tests/engine/support/log_recorder.h"

/// A device with validation that knows the test shaders, and one graph on it.
typedef struct graph_fixture {
    log_recorder recorder;
    lobe_device *device;
    lobe_graph *graph;
} graph_fixture;

/// For cmocka: a new fixture for each test. Closing fails if the validation layer complained, or if
/// memory was not freed.
int graph_fixture_open(void **state);
int graph_fixture_close(void **state);

/// A buffer without content, and an image with one level and one layer.
lobe_resource graph_fixture_buffer(graph_fixture *fixture, const char *name, size_t size);
lobe_resource graph_fixture_image(graph_fixture *fixture, const char *name, lobe_format format,
                                  uint32_t width, uint32_t height);

/// A compute pass with one dispatch of graph_count.comp: target[n] = factor * n for n < count.
/// Returns the buffer's new version.
lobe_resource graph_fixture_count(graph_fixture *fixture, const char *pass, lobe_resource target,
                                  float factor, uint32_t count);
/// A compute pass with one dispatch of graph_add.comp: target[n] = source[n] + offset.
lobe_resource graph_fixture_add(graph_fixture *fixture, const char *pass, lobe_resource source,
                                lobe_resource target, float offset, uint32_t count);

/// The state of a pass of the frame; fails the test if no pass has that name.
lobe_pass_state graph_fixture_state(const graph_fixture *fixture, const char *pass);

/// Executes, and asserts that this succeeds.
void graph_fixture_execute(graph_fixture *fixture);
/// Executes and asserts that this fails with `expected` and exactly one error line, which contains
/// all of `words` (up to the first NULL).
void graph_fixture_expect(graph_fixture *fixture, lobe_result expected, const char *const words[]);
#define GRAPH_EXPECT(fixture, expected, ...)                                                       \
    graph_fixture_expect((fixture), (expected), (const char *const[]){__VA_ARGS__, NULL})

/// Lets the device begin with frames only when the test says so: whoever waited for them before
/// that would wait forever.
typedef struct graph_gate {
    VkSemaphore semaphore;
    VkDevice device;
} graph_gate;

graph_gate graph_gate_close(const graph_fixture *fixture);
void graph_gate_destroy(const graph_gate *gate);
/// Submits the fixture's frame, which the device begins once the gate is open at `value`.
void graph_gate_submit_behind(graph_fixture *fixture, const graph_gate *gate, uint64_t value);
void graph_gate_open(const graph_gate *gate, uint64_t value);

#endif
