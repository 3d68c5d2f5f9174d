#include "tests/passes/support/misuse.h"

#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

lobe_scene *small_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.4, 131));
    scene_end_with_square(scene, &material);
    return scene;
}

void check_it_works(fixture *f) {
    lobe_scene *scene = small_scene();
    picture_request request = {.filter = "lobes", .settings = {NULL}, .width = 4, .height = 4};
    fixture_forget_messages(f);
    lobe_frame frame = draw_scene(f, scene, &request);
    assert_true(largest_value(&frame.radiance) > 0);
    assert_int_equal(f->errors, 0);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

void check_render_failure(fixture *f, const lobe_render_parameters *parameters,
                          lobe_result expected, const char *words) {
    static const lobe_frame nothing;
    lobe_frame frame;
    memset(&frame, 0x55, sizeof frame);
    fixture_forget_messages(f);
    lobe_result result = lobe_renderer_render(f->renderer, parameters, &frame);
    assert_failure(f, result, expected, words);
    assert_memory_equal(&frame, &nothing, sizeof frame);
}
