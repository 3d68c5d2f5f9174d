// Prints the CPU time that the host spends on each part of a frame of fifty passes. To run by hand:
// times differ between machines, so there is nothing to assert.

#include <stdio.h>
#include <stdlib.h>

#include <lobe/vulkan.h>

#include "engine/graph/report.h"
#include "tests/engine/graph/graph_frame.h"
#include "tests/engine/support/test_shaders.h"

#define SETTLING 10 ///< frames that are not counted
#define FRAMES   2000

enum { DECLARE, COMPILE, RECORD, SUBMIT, PARTS };
static const char *const part_names[PARTS] = {"declare", "compile", "record", "submit"};

static int compare(const void *a, const void *b) {
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

static lobe_result measure_frame(graph_frame *frame, double times[PARTS]) {
    const lobe_graph_report *report = lobe_graph_describe(frame->graph);
    const double start = engine_host_milliseconds();
    graph_frame_declare(frame);
    const double declared = engine_host_milliseconds();
    lobe_result result = lobe_graph_compile(frame->graph);
    const double compiled = engine_host_milliseconds();
    times[DECLARE] = declared - start;
    times[COMPILE] = report->host_milliseconds;
    if (result == LOBE_OK)
        result = lobe_graph_submit(frame->graph, &(lobe_vulkan_submission){0});
    times[RECORD] = report->host_milliseconds - times[COMPILE];
    times[SUBMIT] = engine_host_milliseconds() - compiled - times[RECORD];
    return result == LOBE_OK ? lobe_graph_wait(frame->graph) : result;
}

static lobe_result measure(graph_frame *frame) {
    static double times[PARTS][FRAMES];
    lobe_result result = LOBE_OK;
    for (int i = -SETTLING; result == LOBE_OK && i < FRAMES; i++) {
        double parts[PARTS];
        frame->time = (float)i;
        result = measure_frame(frame, parts);
        for (int part = 0; i >= 0 && part < PARTS; part++)
            times[part][i] = parts[part];
    }
    printf("%d passes, median of %d frames:", GRAPH_FRAME_PASSES, FRAMES);
    for (int part = 0; part < PARTS; part++) {
        qsort(times[part], FRAMES, sizeof **times, compare);
        printf(" %s %.3f ms", part_names[part], times[part][FRAMES / 2]);
    }
    printf("\n");
    return result;
}

int main(void) {
    lobe_device *device;
    graph_frame frame = {0};
    lobe_result result = lobe_device_create(NULL, &device);
    if (result == LOBE_OK)
        result = add_test_shaders(device);
    if (result == LOBE_OK)
        result = graph_frame_open(device, &frame);
    if (result == LOBE_OK)
        result = measure(&frame);
    graph_frame_close(&frame);
    lobe_device_destroy(&device);
    return result != LOBE_OK;
}
