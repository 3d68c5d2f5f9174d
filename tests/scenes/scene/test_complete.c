// The light that is added to a scene without light, and its replacement.

#include "tests/engine/support/cmocka_all.h"

#include <stdlib.h>

#include "scenes/environment/sky.h"
#include "scenes/scene/scene.h"
#include "tests/engine/support/log_recorder.h"

static lobe_scene *scene_of(bool light, bool environment) {
    lobe_scene *scene;
    assert_int_equal(scenes_allocate("s", NULL, &scene), LOBE_OK);
    const lobe_light lamp = {.type = LOBE_LIGHT_POINT, .intensity = {1, 1, 1}};
    if (light)
        assert_int_equal(scenes_add_light(scene, &lamp, NULL), LOBE_OK);
    if (environment)
        assert_int_equal(scenes_environment_sky(4, 2, NULL, &scene->environment), LOBE_OK);
    return scene;
}

static lobe_environment *small_sky(void) {
    lobe_environment *environment;
    assert_int_equal(scenes_environment_sky(2, 1, NULL, &environment), LOBE_OK);
    return environment;
}

static void light_is_added_where_there_is_none(void **state) {
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        log_recorder recorder;
        log_recorder_start(&recorder);
        lobe_scene *scene = scene_of(kind & 1, kind & 2);
        assert_int_equal(scenes_add_missing_light(scene, &recorder.host), LOBE_OK);
        assert_int_equal(scene->has_added_light, kind == 0);
        assert_int_equal(recorder.notices, kind == 0);
        assert_int_equal(scene->light_count, kind & 1);
        assert_true((scene->environment != NULL) == (kind != 1));
        if (kind == 0)
            assert_string_equal(scene->environment->name, "sky");
        lobe_scene_destroy(&scene);
    }
}

static void an_environment_takes_the_place_of_added_light(void **state) {
    (void)state;
    lobe_scene *scene = scene_of(false, false);
    assert_int_equal(scenes_add_missing_light(scene, NULL), LOBE_OK);
    lobe_environment *environment = small_sky();
    lobe_scene_set_environment(scene, environment);
    assert_ptr_equal(scene->environment, environment);
    assert_false(scene->has_added_light);
    lobe_scene_set_environment(scene, small_sky()); // the sanitizer checks that the first is freed
    lobe_scene_set_environment(scene, NULL);
    assert_null(scene->environment);
    lobe_scene_destroy(&scene);
}

static void lights_of_the_scene_stay(void **state) {
    (void)state;
    lobe_scene *scene = scene_of(true, true);
    assert_int_equal(scenes_add_missing_light(scene, NULL), LOBE_OK);
    lobe_scene_set_environment(scene, small_sky());
    assert_int_equal(scene->light_count, 1);
    assert_int_equal(scene->environment->image.width, 2);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_added_where_there_is_none),
        cmocka_unit_test(an_environment_takes_the_place_of_added_light),
        cmocka_unit_test(lights_of_the_scene_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
