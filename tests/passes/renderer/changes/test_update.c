// A scene that changes between frames: pictures equal those of a scene that was always like that,
// and only maps that depend on the change are rebuilt.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/upload/scene_upload.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

static const uint32_t extent = 16;

/// Two adjacent squares with different materials, whose lobes vary; a third material and a fourth
/// image that nothing uses yet.
static lobe_scene *changing_scene(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    float left[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, -0.5f, 0, 0, 1};
    float right[16] = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0, 0, 1};
    material.base_colour[0] = 0.5f;
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 7));
    scene_add_square(scene, &material, 1, left);
    lobe_material_default(&material);
    material.roughness = 0.4f;
    material.normal_map = scene_add_map(scene, random_normal_map(8, 32, 0.5, 8));
    material.base_colour_map = scene_add_map(scene, random_map(16, 16, 0, 1, 9));
    scene_add_square(scene, &material, 1, right);
    scene_add_map(scene, random_normal_map(4, 4, 0.5, 10));
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 2);
    scene_look_down(scene, 2.2);
    scene_end(scene);
    return scene;
}

static lobe_frame draw_with(fixture *f, const char *filter) {
    picture_request request = {
        .filter = filter, .settings = {NULL}, .width = extent, .height = extent};
    return draw(f, &request);
}

/// From other texels, moments fits other bins than a renderer that never had the first ones.
/// `fitted`: that is so. Nothing else may differ.
static void check_pictures(const lobe_image *picture, const lobe_image *expected, bool fitted) {
    if (fitted)
        assert_true(relative_l2(picture, expected) < 1e-5);
    else
        assert_memory_equal(picture->texels, expected->texels, (size_t)extent * extent * 16);
}

/// Takes over changes, draws, and asserts that a new renderer draws the same. Returns how many
/// passes ran, including shading.
static size_t check_change(fixture *f, const char *filter, const lobe_scene *scene,
                           const lobe_scene_changes *changes) {
    if (lobe_renderer_update_scene(f->renderer, changes) != LOBE_OK)
        fail_msg("%s", f->error);
    lobe_frame frame = draw_with(f, filter);
    size_t ran = count_passes(lobe_renderer_graph(f->renderer), NULL, LOBE_PASS_RUN);
    fixture fresh = *f;
    assert_int_equal(lobe_renderer_create(f->device, &f->host, &fresh.renderer), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(fresh.renderer, scene), LOBE_OK);
    lobe_frame expected = draw_with(&fresh, filter);
    const size_t refits =
        count_passes(lobe_renderer_graph(f->renderer), "moment_refit", LOBE_PASS_RUN) +
        count_passes(lobe_renderer_graph(f->renderer), "moment_refit", LOBE_PASS_SKIPPED);
    check_pictures(&frame.radiance, &expected.radiance, refits > 0);
    lobe_renderer_destroy(&fresh.renderer);
    lobe_frame_free(&frame);
    lobe_frame_free(&expected);
    return ran;
}

/// Draws the unchanged scene, which builds the maps.
static lobe_scene *start(fixture *f, const char *filter, uint64_t *picture) {
    lobe_scene *scene = changing_scene();
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame frame = draw_with(f, filter);
    *picture = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return scene;
}

static void stop(fixture *f, lobe_scene **scene) {
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(scene);
}

static uint64_t picture_now(fixture *f, const char *filter) {
    lobe_frame frame = draw_with(f, filter);
    uint64_t hash = image_hash(&frame.radiance);
    lobe_frame_free(&frame);
    return hash;
}

// ---------------------------------------------------------------------------------------------
// What needs no map

static void what_moves_or_shines_rebuilds_nothing(void **state) {
    static const uint32_t second = 1;
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    assert_int_equal(check_change(f, "lobes", scene, &(lobe_scene_changes){0}), 1);
    assert_true(picture_now(f, "lobes") == before);
    scene->lights[0].intensity[0] *= 2;
    assert_int_equal(check_change(f, "lobes", scene, &(lobe_scene_changes){0}), 1);
    uint64_t lit = picture_now(f, "lobes");
    assert_true(lit != before);
    // Rotated and moved away; then flattened, which no rotation does.
    float *transform = scene->instances[1].transform;
    transform[12] += 0.25f;
    transform[0] = transform[10] = 0.3f;
    transform[2] = -0.4f;
    transform[8] = 0.4f;
    const lobe_scene_changes moved = {.instances = &second, .instance_count = 1};
    assert_int_equal(check_change(f, "lobes", scene, &moved), 1);
    assert_true(picture_now(f, "lobes") != lit);
    transform[0] *= 0.5f;
    assert_int_equal(check_change(f, "lobes", scene, &moved), 1);
    stop(f, &scene);
}

static void colours_rebuild_no_lobes(void **state) {
    static const uint32_t both[] = {0, 1};
    static const char *const filters[] = {"lobes", "lean", "toksvig", "moments"};
    fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        uint64_t before;
        lobe_scene *scene = start(f, filters[i], &before);
        scene->materials[0].base_colour[0] = 0.75f;
        scene->materials[0].lobes[0].colour[1] *= 0.5f;
        scene->materials[0].lobes[0].colour[0] *= 0.5f;
        scene->materials[0].lobes[0].colour[2] *= 0.5f;
        scene->materials[1].base_colour[2] = 0.25f;
        size_t ran = check_change(f, filters[i], scene,
                                  &(lobe_scene_changes){.materials = both, .material_count = 2});
        // Only the moments of a metal's lobes include its colour.
        if (i < 3)
            assert_int_equal(ran, 1);
        assert_true(picture_now(f, filters[i]) != before);
        stop(f, &scene);
    }
}

// ---------------------------------------------------------------------------------------------
// What needs a map

static size_t ran_and_skipped(fixture *f, const char *pass, size_t *skipped) {
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    *skipped = count_passes(graph, pass, LOBE_PASS_SKIPPED);
    return count_passes(graph, pass, LOBE_PASS_RUN);
}

static void one_materials_width_rebuilds_its_lobes(void **state) {
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    for (uint32_t material = 0; material < 2; material++) {
        scene->materials[material].roughness = 0.6f;
        scene->materials[material].lobes[0].width = 60;
        const lobe_scene_changes changes = {.materials = &material, .material_count = 1};
        check_change(f, "lobes", scene, &changes);
        size_t skipped, ran = ran_and_skipped(f, "lobe_clustering", &skipped);
        assert_int_equal(ran, 1);
        assert_int_equal(skipped, 1);
        assert_true(picture_now(f, "lobes") != before);
    }
    stop(f, &scene);
}

static void texels_rebuild_what_is_made_of_them(void **state) {
    static const char *const filters[] = {"lobes", "leadr", "moments"};
    static const char *const passes[] = {"lobe_clustering", "slope_moments", "moment_binning"};
    static const uint32_t normals = 1, colours = 2;
    fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        uint64_t before;
        lobe_scene *scene = start(f, filters[i], &before);
        lobe_image other = random_normal_map(8, 32, 0.2, 21);
        memcpy(scene->images[normals].image.texels, other.texels, 8 * 32 * 16);
        lobe_image_free(&other);
        check_change(f, filters[i], scene,
                     &(lobe_scene_changes){.images = &normals, .image_count = 1});
        size_t skipped, ran = ran_and_skipped(f, passes[i], &skipped);
        assert_int_equal(ran, 1);
        assert_int_equal(skipped, 1);
        assert_true(picture_now(f, filters[i]) != before);
        // The colour map is filtered on its own.
        memset(scene->images[colours].image.texels, 0, 16 * 16 * 16);
        check_change(f, filters[i], scene,
                     &(lobe_scene_changes){.images = &colours, .image_count = 1});
        if (i < 2)
            assert_int_equal(ran_and_skipped(f, passes[i], &skipped), 0);
        stop(f, &scene);
    }
}

static void maps_may_change_their_extent(void **state) {
    static const uint32_t normals = 0;
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    lobe_image_free(&scene->images[0].image);
    scene->images[0].image = random_normal_map(32, 8, 0.3, 22);
    check_change(f, "lobes", scene, &(lobe_scene_changes){.images = &normals, .image_count = 1});
    size_t skipped;
    assert_int_equal(ran_and_skipped(f, "lobe_clustering", &skipped), 1);
    assert_true(picture_now(f, "lobes") != before);
    stop(f, &scene);
}

static void materials_may_get_and_lose_maps(void **state) {
    static const uint32_t first = 0;
    static const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    scene->materials[0].normal_map.image = 3;
    check_change(f, "lobes", scene, &changes);
    uint64_t other = picture_now(f, "lobes");
    assert_true(other != before);
    scene->materials[0].normal_map.image = -1;
    check_change(f, "lobes", scene, &changes);
    assert_true(picture_now(f, "lobes") != other);
    scene->materials[0].normal_map.image = 0;
    check_change(f, "lobes", scene, &changes);
    assert_true(picture_now(f, "lobes") == before);
    stop(f, &scene);
}

static void meshes_and_instances_may_change(void **state) {
    static const uint32_t first = 0;
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    lobe_mesh *mesh = &scene->meshes[0];
    for (size_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].position[0] *= 0.5f;
    assert_int_equal(
        check_change(f, "lobes", scene, &(lobe_scene_changes){.meshes = &first, .mesh_count = 1}),
        1);
    mesh->index_count = 3;
    check_change(f, "lobes", scene, &(lobe_scene_changes){.meshes = &first, .mesh_count = 1});
    uint64_t half = picture_now(f, "lobes");
    assert_true(half != before);
    // Two instances of one material: the maps of the other go.
    scene->instances[0].material = 1;
    check_change(f, "lobes", scene,
                 &(lobe_scene_changes){.instances = &first, .instance_count = 1});
    assert_true(picture_now(f, "lobes") != half);
    stop(f, &scene);
}

// ---------------------------------------------------------------------------------------------
// Mistakes

static void mistakes_change_nothing(void **state) {
    static const uint32_t first = 0, absent = 99;
    fixture *f = *state;
    uint64_t before;
    lobe_scene *scene = start(f, "lobes", &before);
    assert_failure(
        f,
        lobe_renderer_update_scene(
            f->renderer, &(lobe_scene_changes){.materials = &absent, .material_count = 1}),
        LOBE_ERROR_INVALID_ARGUMENT, "material 99");
    // Both are listed as changed; the second is invalid.
    scene->materials[0].lobes[0].width = 90;
    scene->materials[0].lobe_count = 77;
    fixture_forget_messages(f);
    assert_failure(
        f,
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.materials = &first, .material_count = 1}),
        LOBE_ERROR_MALFORMED, "77 lobes");
    scene->materials[0].lobe_count = 1;
    scene->materials[0].lobes[0].width = 30;
    // An image that the device does not have yet.
    ((float *)scene->images[3].image.texels)[5] = NAN;
    scene->materials[0].normal_map.image = 3;
    fixture_forget_messages(f);
    assert_failure(
        f,
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.materials = &first, .material_count = 1}),
        LOBE_ERROR_MALFORMED, "not finite");
    scene->materials[0].normal_map.image = 0;
    scene->instances[0].mesh = 50;
    fixture_forget_messages(f);
    assert_failure(
        f,
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.instances = &first, .instance_count = 1}),
        LOBE_ERROR_MALFORMED, "mesh 50");
    scene->instances[0].mesh = 0;
    assert_true(picture_now(f, "lobes") == before);
    stop(f, &scene);
    fixture_forget_messages(f);
    assert_failure(f, lobe_renderer_update_scene(f->renderer, &(lobe_scene_changes){0}),
                   LOBE_ERROR_INVALID_ARGUMENT, "no scene");
}

/// How much the version of material 1 grows with a change of it or of an image.
static uint32_t version_grows(fixture *f, device_scene *uploaded, const uint32_t *image) {
    static const uint32_t second = 1;
    const lobe_scene_changes changes = {.materials = &second,
                                        .material_count = image ? 0 : 1,
                                        .images = image,
                                        .image_count = image ? 1 : 0};
    uint32_t before = uploaded->materials[1].version;
    assert_int_equal(passes_device_scene_update(uploaded, &changes, &f->host), LOBE_OK);
    return uploaded->materials[1].version - before;
}

/// What filters keep of a material is valid for a version of it.
static void paint_keeps_what_was_prepared(void **state) {
    fixture *f = *state;
    lobe_scene *scene = changing_scene();
    lobe_material *material = &scene->materials[1];
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    material->base_colour[1] = 0.25f;
    material->emissive[0] = 1;
    material->occlusion_strength = 0.5f;
    assert_int_equal(version_grows(f, uploaded, NULL), 0);
    material->roughness = 0.3f;
    assert_int_equal(version_grows(f, uploaded, NULL), 1);
    material->metallic = 0.5f;
    assert_int_equal(version_grows(f, uploaded, NULL), 1);
    material->distribution = LOBE_DISTRIBUTION_BECKMANN;
    assert_int_equal(version_grows(f, uploaded, NULL), 1);
    const uint32_t other = 3, own = (uint32_t)material->normal_map.image;
    material->normal_map.image = (int32_t)other;
    assert_int_equal(version_grows(f, uploaded, NULL), 1);
    const uint32_t parameters = uploaded->materials[1].parameter_version;
    assert_int_equal(version_grows(f, uploaded, &other), 1);
    assert_int_equal(version_grows(f, uploaded, &own), 0);
    assert_int_equal(uploaded->materials[1].parameter_version, parameters);
    // Without texels on the host, nothing was prepared that others could adapt.
    void *texels = scene->images[other].image.texels;
    scene->images[other].image.texels = NULL;
    scene->images[other].on_device = true;
    assert_int_equal(version_grows(f, uploaded, &other), 2);
    assert_int_equal(uploaded->materials[1].parameter_version, parameters + 1);
    scene->images[other].image.texels = texels;
    lobe_graph_begin(f->graph);
    passes_device_scene_destroy(&uploaded);
    lobe_scene_destroy(&scene);
}

/// What shading knows of a map is that of the texels on the device, not of those that the host is
/// still writing.
static void channels_are_those_of_announced_texels(void **state) {
    static const uint32_t first = 0;
    const lobe_scene_changes material = {.materials = &first, .material_count = 1};
    fixture *f = *state;
    lobe_scene *scene = scene_begin();
    lobe_material metal = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1);
    metal.metallic_roughness_map = scene_add_map(scene, random_map(8, 8, 0.5, 0.5, 3));
    scene_end_with_square(scene, &metal);
    const uint32_t map = (uint32_t)metal.metallic_roughness_map.image;
    const lobe_scene_changes texels = {.images = &map, .image_count = 1};
    float *first_texel = (float *)scene->images[map].image.texels;
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    const device_material *known = &uploaded->materials[0];
    for (int n = 0; n < 2; n++) {
        const bool varied = n == 1;
        for (int channel = 1; channel < 3; channel++)
            first_texel[channel] += n ? -0.25f : 0.25f;
        assert_int_equal(passes_device_scene_update(uploaded, &material, &f->host), LOBE_OK);
        assert_true(known->metallic_varies == varied && known->widths_vary == varied);
        assert_int_equal(passes_device_scene_update(uploaded, &texels, &f->host), LOBE_OK);
        assert_true(known->metallic_varies == !varied && known->widths_vary == !varied);
    }
    assert_float_equal(known->metallic, 0.5, 1e-6);
    lobe_graph_begin(f->graph);
    passes_device_scene_destroy(&uploaded);
    lobe_scene_destroy(&scene);
}

/// A mesh, which may be large, is looked at when it is announced, or a map is laid out otherwise.
static void layouts_are_those_of_announced_meshes(void **state) {
    static const uint32_t first = 0;
    const lobe_scene_changes material = {.materials = &first, .material_count = 1};
    const lobe_scene_changes mesh = {.meshes = &first, .mesh_count = 1};
    fixture *f = *state;
    lobe_scene *scene = changing_scene();
    float *coordinate = scene->meshes[0].vertices[0].texture_coordinates[0];
    float *scale = &scene->materials[0].normal_map.transform[0][0];
    const float placed = *coordinate;
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    const device_instance *known = &uploaded->instances[0];
    assert_true(known->is_atlas);
    *coordinate = 5;
    assert_int_equal(passes_device_scene_update(uploaded, &material, &f->host), LOBE_OK);
    assert_true(known->is_atlas);
    assert_int_equal(passes_device_scene_update(uploaded, &mesh, &f->host), LOBE_OK);
    assert_false(known->is_atlas);
    *coordinate = placed;
    assert_int_equal(passes_device_scene_update(uploaded, &mesh, &f->host), LOBE_OK);
    assert_true(known->is_atlas);
    *scale = 3;
    assert_int_equal(passes_device_scene_update(uploaded, &material, &f->host), LOBE_OK);
    assert_false(known->is_atlas);
    lobe_graph_begin(f->graph);
    passes_device_scene_destroy(&uploaded);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_moves_or_shines_rebuilds_nothing),
        cmocka_unit_test(colours_rebuild_no_lobes),
        cmocka_unit_test(one_materials_width_rebuilds_its_lobes),
        cmocka_unit_test(texels_rebuild_what_is_made_of_them),
        cmocka_unit_test(maps_may_change_their_extent),
        cmocka_unit_test(materials_may_get_and_lose_maps),
        cmocka_unit_test(meshes_and_instances_may_change),
        cmocka_unit_test(mistakes_change_nothing),
        cmocka_unit_test(paint_keeps_what_was_prepared),
        cmocka_unit_test(channels_are_those_of_announced_texels),
        cmocka_unit_test(layouts_are_those_of_announced_meshes),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
