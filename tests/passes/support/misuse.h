#ifndef TESTS_PASSES_SUPPORT_MISUSE_H
#define TESTS_PASSES_SUPPORT_MISUSE_H

#include <lobe/renderer.h>
#include <lobe/scene.h>

#include "tests/passes/support/fixture.h"

/// For tests that misuse the renderer.

/// A square with a normal map, under one light; destroyed with lobe_scene_destroy.
lobe_scene *small_scene(void);
/// Asserts that the renderer still draws a scene.
void check_it_works(fixture *f);
/// Asserts that a picture fails with exactly this code and one line with `words`, and that nothing
/// is delivered.
void check_render_failure(fixture *f, const lobe_render_parameters *parameters,
                          lobe_result expected, const char *words);

#endif
