// Maps without a renderer: what is recorded, what stays the same while texels change, and what is
// refused. Pictures drawn with them are compared in the tests of the examples.

#include "tests/passes/support/fixture.h"

#include <string.h>

#include <lobe/maps.h>
#include <lobe/vulkan.h>

#include "tests/engine/support/counting_allocator.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { MAP = 16 };

static const lobe_vulkan_submission plain = {0};

static lobe_scene *mapped_scene(uint64_t seed) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.9, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(MAP, MAP, 0.5, seed));
    material.metallic_roughness_map = scene_add_map(scene, constant_map(MAP, MAP, 0, 0.5f, 1));
    material.base_colour_map = scene_add_map(scene, random_map(MAP, MAP, 0.1, 0.9, seed + 1));
    scene_end_with_square(scene, &material);
    return scene;
}

static lobe_maps *make_maps(fixture *f, const lobe_scene *scene, const char *filter) {
    const lobe_maps_parameters parameters = {.scene = scene, .filter = filter_named(filter)};
    lobe_maps *maps;
    if (lobe_maps_create(f->device, &parameters, &f->host, &maps) != LOBE_OK)
        fail_msg("%s", f->error);
    return maps;
}

static void record(fixture *f, lobe_maps *maps) {
    if (lobe_maps_record(maps, &plain) != LOBE_OK ||
        lobe_graph_wait(lobe_maps_graph(maps)) != LOBE_OK)
        fail_msg("%s", f->error);
}

static void end(fixture *f, lobe_maps **maps, lobe_scene **scene) {
    lobe_maps_destroy(maps);
    lobe_scene_destroy(scene);
    assert_int_equal(f->errors, 0);
    assert_int_equal(lobe_device_validation_count(f->device), 0);
}

/// A copy of what lobe_maps_get gives, which a later recording replaces.
typedef struct material_copy {
    lobe_vulkan_descriptor descriptors[64];
    lobe_specialisation constants[128];
    size_t descriptor_count, constant_count;
} material_copy;

static material_copy copy_material(fixture *f, const lobe_maps *maps) {
    material_copy copy = {0};
    lobe_material_maps material;
    if (lobe_maps_get(maps, 0, &material) != LOBE_OK)
        fail_msg("%s", f->error);
    assert_in_range(material.descriptor_count, 1, 64);
    assert_in_range(material.constant_count, 1, 128);
    copy.descriptor_count = material.descriptor_count;
    copy.constant_count = material.constant_count;
    memcpy(copy.descriptors, material.descriptors,
           material.descriptor_count * sizeof *material.descriptors);
    memcpy(copy.constants, material.constants,
           material.constant_count * sizeof *material.constants);
    return copy;
}

static void assert_same(const material_copy *a, const material_copy *b) {
    assert_int_equal(a->descriptor_count, b->descriptor_count);
    for (size_t i = 0; i < a->descriptor_count; i++) {
        assert_int_equal(a->descriptors[i].binding, b->descriptors[i].binding);
        assert_true(a->descriptors[i].image.imageView == b->descriptors[i].image.imageView);
        assert_true(a->descriptors[i].image.sampler == b->descriptors[i].image.sampler);
        assert_true(a->descriptors[i].buffer.buffer == b->descriptors[i].buffer.buffer);
    }
    assert_int_equal(a->constant_count, b->constant_count);
    assert_memory_equal(a->constants, b->constants, a->constant_count * sizeof *a->constants);
}

static void what_has_not_changed_is_not_recorded(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(1);
    lobe_maps *maps = make_maps(f, scene, "moments");
    record(f, maps);
    assert_true(count_passes(lobe_maps_graph(maps), NULL, LOBE_PASS_RUN) > 5);
    // An update that lists nothing builds nothing.
    assert_int_equal(lobe_maps_update(maps, &(lobe_scene_changes){0}), LOBE_OK);
    record(f, maps);
    assert_int_equal(count_passes(lobe_maps_graph(maps), NULL, LOBE_PASS_RUN), 1);
    // Without one, there is not even a frame: a submission that cannot be is not looked at.
    const lobe_vulkan_submission impossible = {.wait_count = 1000};
    assert_int_equal(lobe_maps_record(maps, &impossible), LOBE_OK);
    end(f, &maps, &scene);
}

/// Other normals and widths, and other metal: the same everywhere, or not.
static void change_texels(lobe_scene *scene, float metal, bool varies) {
    float *normals = scene->images[0].image.texels, *widths = scene->images[1].image.texels;
    for (size_t i = 0; i < 4 * MAP * MAP; i += 4) {
        normals[i] = 1 - normals[i];
        widths[i + 1] = 0.25f + (float)(i % 5) / 8;
        widths[i + 2] = varies ? (float)(i % 7) / 7 : metal;
    }
}

static material_copy changed_material(fixture *f, lobe_maps *maps, lobe_scene *scene, float metal,
                                      bool varies) {
    static const uint32_t images[] = {0, 1};
    change_texels(scene, metal, varies);
    assert_int_equal(
        lobe_maps_update(maps, &(lobe_scene_changes){.images = images, .image_count = 2}), LOBE_OK);
    record(f, maps);
    assert_true(count_passes(lobe_maps_graph(maps), "level_reduction", LOBE_PASS_RUN) > 0);
    return copy_material(f, maps);
}

static void handles_and_constants_stay_while_texels_change(void **state) {
    fixture *f = *state;
    static const char *const filters[] = {"toksvig", "lean", "lobes", "moments"};
    for (size_t i = 0; i < 4; i++) {
        lobe_scene *scene = mapped_scene(2);
        lobe_maps *maps = make_maps(f, scene, filters[i]);
        record(f, maps);
        const material_copy before = copy_material(f, maps);
        const material_copy after = changed_material(f, maps, scene, 0.5f, false);
        assert_same(&before, &after);
        end(f, &maps, &scene);
    }
}

/// Also where others have the same maps, and keep them.
static void handles_stay_beside_others_of_the_same_scene(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(2);
    lobe_maps *others = make_maps(f, scene, "lean");
    record(f, others);
    lobe_maps *maps = make_maps(f, scene, "lean");
    record(f, maps);
    const material_copy before = copy_material(f, maps), theirs = copy_material(f, others);
    const material_copy after = changed_material(f, maps, scene, 0.5f, false);
    assert_same(&before, &after);
    assert_int_equal(lobe_maps_update(others, &(lobe_scene_changes){0}), LOBE_OK);
    record(f, others);
    const material_copy unchanged = copy_material(f, others);
    assert_same(&theirs, &unchanged);
    lobe_maps_destroy(&others);
    end(f, &maps, &scene);
}

/// A mask stays where texels are changed to keep all, and goes with the material's.
static void a_mask_goes_with_that_of_its_material(void **state) {
    static const uint32_t first = 0;
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(6);
    lobe_maps *never = make_maps(f, scene, "lean");
    record(f, never);
    scene->materials[0].alpha_mask = true;
    scene->materials[0].alpha_cutoff = 0.5f;
    lobe_maps *maps = make_maps(f, scene, "lean");
    record(f, maps);
    const material_copy expected = copy_material(f, never), masked = copy_material(f, maps);
    assert_memory_not_equal(expected.constants, masked.constants, sizeof masked.constants);
    scene->materials[0].alpha_mask = false;
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    assert_int_equal(lobe_maps_update(maps, &changes), LOBE_OK);
    record(f, maps);
    const material_copy plain = copy_material(f, maps);
    assert_memory_equal(expected.constants, plain.constants, sizeof plain.constants);
    lobe_maps_destroy(&never);
    end(f, &maps, &scene);
}

static void metal_that_begins_to_vary_changes_constants_once(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(2);
    lobe_maps *maps = make_maps(f, scene, "moments");
    record(f, maps);
    const material_copy constant = copy_material(f, maps);
    const material_copy varied = changed_material(f, maps, scene, 0, true);
    assert_int_equal(constant.constant_count, varied.constant_count);
    assert_memory_not_equal(constant.constants, varied.constants,
                            constant.constant_count * sizeof *constant.constants);
    const material_copy back = changed_material(f, maps, scene, 0.5f, false);
    assert_same(&varied, &back);
    end(f, &maps, &scene);
}

/// Gives the scene's own texels.
static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    assert_null(content->vertices);
    content->images[0] = lobe_graph_import_texture(graph, user);
}

static void images_may_be_on_the_device(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(3);
    lobe_texture *texture;
    assert_int_equal(
        lobe_texture_create(f->device, &(lobe_texture_parameters){.image = &scene->images[0].image},
                            &texture),
        LOBE_OK);
    scene->images[0].on_device = true;
    const lobe_maps_parameters parameters = {.scene = scene, .give_content = give, .user = texture};
    lobe_maps *maps;
    assert_int_equal(lobe_maps_create(f->device, &parameters, &f->host, &maps), LOBE_OK);
    record(f, maps);
    const material_copy first = copy_material(f, maps);
    assert_int_equal(lobe_texture_update(texture, &scene->images[0].image), LOBE_OK);
    record(f, maps);
    assert_true(count_passes(lobe_maps_graph(maps), "level_reduction", LOBE_PASS_RUN) > 0);
    const material_copy second = copy_material(f, maps);
    assert_same(&first, &second);
    lobe_maps_destroy(&maps);
    lobe_texture_destroy(&texture);
    end(f, &maps, &scene);
}

static void check_refused(fixture *f, const lobe_maps_parameters *parameters, lobe_result expected,
                          const char *words) {
    lobe_maps *maps;
    fixture_forget_messages(f);
    const lobe_result result = lobe_maps_create(f->device, parameters, &f->host, &maps);
    assert_failure(f, result, expected, words);
    assert_null(maps);
    fixture_forget_messages(f);
}

static void mistakes_are_named(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(4);
    check_refused(f, &(lobe_maps_parameters){0}, LOBE_ERROR_INVALID_ARGUMENT, "scene");
    check_refused(f, &(lobe_maps_parameters){.scene = scene, .filter = filter_named("reference")},
                  LOBE_ERROR_INVALID_ARGUMENT, "'reference'");
    check_refused(f, &(lobe_maps_parameters){.scene = scene, .lights_at_once = 5},
                  LOBE_ERROR_INVALID_ARGUMENT, "5 lights");
    scene->materials[0].roughness = 2;
    check_refused(f, &(lobe_maps_parameters){.scene = scene}, LOBE_ERROR_MALFORMED, "'material'");
    scene->materials[0].roughness = 1;
    lobe_material unnamed = {.name = NULL}; // uses image 0
    check_refused(
        f,
        &(lobe_maps_parameters){.scene = &(lobe_scene){.materials = &unnamed, .material_count = 1}},
        LOBE_ERROR_MALFORMED, "material 0 uses image 0 of 0");
    lobe_maps *maps = make_maps(f, scene, "moments");
    lobe_material_maps material;
    assert_failure(f, lobe_maps_get(maps, 0, &material), LOBE_ERROR_INVALID_ARGUMENT, "'material'");
    fixture_forget_messages(f);
    assert_failure(f, lobe_maps_get(maps, 1, &material), LOBE_ERROR_INVALID_ARGUMENT,
                   "no material 1");
    fixture_forget_messages(f);
    static const uint32_t first = 0;
    assert_failure(f,
                   lobe_maps_update(maps, &(lobe_scene_changes){.meshes = &first, .mesh_count = 1}),
                   LOBE_ERROR_INVALID_ARGUMENT, "no meshes");
    fixture_forget_messages(f);
    end(f, &maps, &scene);
}

static void missing_texels_are_named(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(5);
    scene->images[0].on_device = true;
    lobe_maps *maps = make_maps(f, scene, "toksvig");
    assert_failure(f, lobe_maps_record(maps, &plain), LOBE_ERROR_INVALID_ARGUMENT, "'map'");
    fixture_forget_messages(f);
    end(f, &maps, &scene);
}

// ---------------------------------------------------------------------------------------------
// Memory

/// Creation, a recording, a change, another recording: the first failure.
static lobe_result build_and_change(lobe_device *device, lobe_scene *scene, const lobe_host *host) {
    static const uint32_t first = 0;
    const lobe_maps_parameters parameters = {.scene = scene};
    const lobe_scene_changes changes = {.images = &first, .image_count = 1};
    lobe_maps *maps;
    lobe_result result = lobe_maps_create(device, &parameters, host, &maps);
    result = result ? result : lobe_maps_record(maps, &plain);
    result = result ? result : lobe_maps_update(maps, &changes);
    result = result ? result : lobe_maps_record(maps, &plain);
    lobe_maps_destroy(&maps);
    return result;
}

static void each_allocation_fails_once(void **state) {
    fixture *f = *state;
    lobe_scene *scene = mapped_scene(6);
    counting_allocator counting;
    counting_allocator_start(&counting);
    const lobe_host host = {
        .allocator = &counting.allocator, .write = f->host.write, .user = f->host.user};
    lobe_device *device;
    assert_int_equal(lobe_device_create(&(lobe_device_parameters){.host = &host}, &device),
                     LOBE_OK);
    // The device keeps pipelines.
    assert_int_equal(build_and_change(device, scene, &host), LOBE_OK);
    const size_t blocks = counting.blocks;
    counting.taken = 0;
    assert_int_equal(build_and_change(device, scene, &host), LOBE_OK);
    const size_t count = counting.taken;
    assert_true(count > 100);
    for (counting.failing = 1; counting.failing <= count; counting.failing++) {
        fixture_forget_messages(f);
        counting.taken = 0;
        assert_failure(f, build_and_change(device, scene, &host), LOBE_ERROR_OUT_OF_MEMORY, "");
        assert_int_equal(counting.blocks, blocks);
    }
    fixture_forget_messages(f);
    lobe_device_destroy(&device);
    assert_nothing_left(&counting);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_has_not_changed_is_not_recorded),
        cmocka_unit_test(handles_and_constants_stay_while_texels_change),
        cmocka_unit_test(handles_stay_beside_others_of_the_same_scene),
        cmocka_unit_test(a_mask_goes_with_that_of_its_material),
        cmocka_unit_test(metal_that_begins_to_vary_changes_constants_once),
        cmocka_unit_test(images_may_be_on_the_device),
        cmocka_unit_test(mistakes_are_named),
        cmocka_unit_test(missing_texels_are_named),
        cmocka_unit_test(each_allocation_fails_once),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
