// Prints the CPU time that the host spends on a frame of fifty passes, part by part: a program to
// run by hand, since no machine is as fast as the next.

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <lobe/vulkan.h>

#include "tests/engine/graph_frame.h"
#include "tests/engine/test_shaders.h"

enum { BEGUN_AND_DECLARED, COMPILED, SUBMITTED, PARTS };

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static int compare(const void *a, const void *b) {
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

int main(int argc, char **argv) {
    static double parts[PARTS][100000];
    const int frames = argc > 1 ? atoi(argv[1]) : 1000;
    lobe_device *device;
    graph_frame frame;
    if (lobe_device_create(NULL, &device) || add_test_shaders(device) ||
        graph_frame_open(device, &frame))
        return 1;
    for (int n = -10; n < frames; n++) {
        double times[PARTS + 1] = {now()};
        frame.time = (float)n;
        graph_frame_declare(&frame);
        times[1] = now();
        if (lobe_graph_compile(frame.graph))
            return 1;
        times[2] = now();
        if (lobe_graph_submit(frame.graph, &(lobe_vulkan_submission){0}))
            return 1;
        times[3] = now();
        lobe_graph_wait(frame.graph);
        for (int part = 0; n >= 0 && part < PARTS; part++)
            parts[part][n] = times[part + 1] - times[part];
    }
    for (int part = 0; part < PARTS; part++)
        qsort(parts[part], (size_t)frames, sizeof **parts, compare);
    printf("declare %.3f ms, compile %.3f ms, record and submit %.3f ms\n", parts[0][frames / 2],
           parts[1][frames / 2], parts[2][frames / 2]);
    graph_frame_close(&frame);
    lobe_device_destroy(&device);
    return 0;
}
