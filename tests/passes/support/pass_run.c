#include "tests/passes/support/pass_run.h"

#include <math.h>
#include <stdlib.h>

#include "engine/image/half.h"
#include "passes/upload/scene_upload.h"
#include "tests/passes/support/picture.h"

void pass_run_begin(pass_run *run, fixture *f, const lobe_scene *scene, const char *filter,
                    const char *const *assignments) {
    *run = (pass_run){.fixture = f, .settings = settings_of(filter_named(filter), assignments)};
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &run->scene),
                     LOBE_OK);
    run->context = (filter_context){.graph = f->graph,
                                    .settings = &run->settings,
                                    .filter = filter_named(filter),
                                    .scene = run->scene,
                                    .view = {.camera = &scene->camera},
                                    .host = &f->host};
    lobe_graph_begin(f->graph);
}

void pass_run_execute(pass_run *run) {
    if (lobe_graph_execute(run->fixture->graph) != LOBE_OK)
        fail_msg("%s", run->fixture->error);
}

static float number_at(const void *data, size_t i, lobe_format format) {
    if (format == LOBE_FORMAT_RGBA32_FLOAT)
        return ((const float *)data)[i];
    if (format == LOBE_FORMAT_RGBA16_FLOAT)
        return engine_half_to_float(((const uint16_t *)data)[i]);
    assert_int_equal(format, LOBE_FORMAT_RGBA16_SNORM);
    return fmaxf((float)((const int16_t *)data)[i] / 32767, -1);
}

float *pass_run_read(pass_run *run, const reduced_map *map, lobe_format format) {
    lobe_graph_read_back(run->fixture->graph, map->resource, (lobe_range){0});
    pass_run_execute(run);
    size_t size = 0;
    const void *data = lobe_graph_data(run->fixture->graph, map->resource, &size);
    assert_int_equal(size, passes_reduced_map_bytes(map, format));
    const size_t count = size / lobe_format_size(format) * 4;
    float *numbers = malloc(count * sizeof *numbers);
    assert_non_null(numbers);
    for (size_t i = 0; i < count; i++)
        numbers[i] = number_at(data, i, format);
    return numbers;
}

void pass_run_end(pass_run *run) {
    lobe_graph_begin(run->fixture->graph); // the last frame's passes refer to the scene
    passes_device_scene_destroy(&run->scene);
}
