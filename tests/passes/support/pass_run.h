#ifndef TESTS_PASSES_SUPPORT_PASS_RUN_H
#define TESTS_PASSES_SUPPORT_PASS_RUN_H

#include "passes/context/filter.h"
#include "passes/maps/level_reduction.h"
#include "tests/passes/support/fixture.h"

/// Passes of a filter that a test declares itself, on an uploaded scene.
typedef struct pass_run {
    fixture *fixture;
    lobe_settings settings;
    device_scene *scene;
    filter_context context; ///< points into this structure
} pass_run;

/// Uploads a scene and begins a frame of the fixture's graph. `assignments`: of the filter's knobs,
/// ends with NULL.
void pass_run_begin(pass_run *run, fixture *f, const lobe_scene *scene, const char *filter,
                    const char *const *assignments);
/// Executes the frame.
void pass_run_execute(pass_run *run);
/// Executes the frame and returns a map as four floats per texel: levels from the finest on, layers
/// within a level. The caller frees them.
float *pass_run_read(pass_run *run, const reduced_map *map, lobe_format format);
/// Frees the uploaded scene.
void pass_run_end(pass_run *run);

#endif
