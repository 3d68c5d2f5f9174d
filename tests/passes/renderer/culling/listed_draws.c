#include "tests/passes/renderer/culling/listed_draws.h"

void list_draws(pass_run *run, draw_list *list, const filtered_appearance *maps, bool shared) {
    const device_scene *scene = run->scene;
    assert_true(passes_draw_list_create(list, scene->scene->mesh_count, NULL) &&
                passes_draw_list_reserve(list, scene->scene->instance_count, NULL));
    passes_draw_list_begin(list, scene);
    for (uint32_t m = 0; m < scene->scene->material_count; m++)
        for (uint32_t next = scene->materials[m].first_instance; next > 0;
             next = scene->instances[next - 1].next_of_material)
            passes_draw_list_add(list, scene, next - 1, &maps[shared ? m : next - 1], shared);
    passes_draw_list_end(list, &run->context);
}
