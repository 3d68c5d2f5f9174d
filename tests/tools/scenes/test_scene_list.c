#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/scene.h>

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "tests/engine/support/log_recorder.h"
#include "tests/engine/support/temporary_folder.h"
#include "tests/scenes/scene/scene_check.h"
#include "tools/scenes/scene_list.h"

static const char bunny_file[] = "models/npm_bunny.js";
static const char dragon_file[] = "models/npm_dragon_vrip_res3.ply.gz";

static FILE *create(const char *name) {
    FILE *file = fopen(temporary_folder_file(&test_folder, name), "w");
    assert_non_null(file);
    return file;
}

static void write_bunny(const lobe_mesh *mesh) {
    FILE *file = create(bunny_file);
    fputs("exports.positions=[", file);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position;
        fprintf(file, "%s[%.9g,%.9g,%.9g]", i ? "," : "", p[0], p[1], p[2]);
    }
    fputs("]\nexports.cells=[", file);
    for (size_t i = 0; i < mesh->index_count; i += 3)
        fprintf(file, "%s[%u,%u,%u]", i ? "," : "", mesh->indices[i], mesh->indices[i + 1],
                mesh->indices[i + 2]);
    fputs("]\n", file);
    assert_int_equal(fclose(file), 0);
}

static void write_dragon(const lobe_mesh *mesh) {
    FILE *file = create(dragon_file);
    fprintf(file,
            "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
            "property float z\nelement face %zu\nproperty list uchar int vertex_indices\n"
            "end_header\n",
            mesh->vertex_count, mesh->index_count / 3);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position;
        fprintf(file, "%.9g %.9g %.9g\n", p[0], p[1], p[2]);
    }
    for (size_t i = 0; i < mesh->index_count; i += 3)
        fprintf(file, "3 %u %u %u\n", mesh->indices[i], mesh->indices[i + 1], mesh->indices[i + 2]);
    assert_int_equal(fclose(file), 0);
}

// A folder of assets in which both animals are spheres.
static int set_up(void **state) {
    lobe_mesh sphere;
    test_folder_setup(state);
    assert_int_equal(mkdir(temporary_folder_file(&test_folder, "models"), 0700), 0);
    assert_int_equal(scenes_shape_sphere(24, 48, 1, 1, NULL, &sphere), LOBE_OK);
    write_bunny(&sphere);
    write_dragon(&sphere);
    scenes_mesh_free(&sphere);
    return 0;
}

static int tear_down(void **state) {
    remove(temporary_folder_file(&test_folder, bunny_file));
    remove(temporary_folder_file(&test_folder, dragon_file));
    rmdir(temporary_folder_file(&test_folder, "models"));
    return test_folder_teardown(state);
}

static lobe_scene *open_from(const char *assets, const char *name) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_scene *scene;
    lobe_result result = scene_list_open(name, assets, false, &recorder.host, &scene);
    if (result != LOBE_OK)
        fail_msg("%s", recorder.last_error);
    assert_int_equal(recorder.errors + recorder.warnings, 0);
    assert_string_equal(scene->name, name);
    assert_int_equal(scene->light_count, 3);
    assert_true(scene->has_camera);
    return scene;
}

static const lobe_image *image_of(const lobe_scene *scene, const lobe_texture_use *use,
                                  uint32_t width, uint32_t height) {
    assert_in_range(use->image, 0, scene->image_count - 1);
    assert_int_equal(use->wrap_u, LOBE_SCENE_WRAP_REPEAT);
    assert_int_equal(use->wrap_v, LOBE_SCENE_WRAP_REPEAT);
    const lobe_image *image = &scene->images[use->image].image;
    assert_int_equal(image->width, width);
    assert_int_equal(image->height, height);
    return image;
}

// Root mean square of the differences between neighbouring columns or rows.
static double step(const lobe_image *image, bool rows, uint32_t from) {
    const uint8_t *texels = image->texels;
    uint32_t extent = rows ? image->height : image->width;
    uint32_t along = rows ? image->width : image->height, to = (from + 1) % extent;
    double sum = 0;
    for (size_t i = 0; i < along; i++) {
        size_t a = (rows ? from * image->width + i : i * image->width + from) * 4;
        size_t b = (rows ? to * image->width + i : i * image->width + to) * 4;
        for (int channel = 0; channel < 3; channel++)
            sum += pow(texels[a + channel] - texels[b + channel], 2);
    }
    return sqrt(sum / along);
}

// At a mismatched edge, the difference would be larger than between any neighbours elsewhere.
static void assert_tiles(const lobe_image *image) {
    for (int rows = 0; rows < 2; rows++) {
        uint32_t extent = rows ? image->height : image->width;
        double greatest = 0;
        for (uint32_t i = 0; i + 1 < extent; i += 5)
            greatest = fmax(greatest, step(image, rows, i));
        assert_true(step(image, rows, extent - 1) < 1.1 * greatest);
    }
}

// As for built-in scenes: the hash of the bytes that every machine makes. If you change a scene on
// purpose, change its number.
static void assert_hash(const lobe_scene *scene, uint64_t expected) {
    uint64_t hash = scene_check_hash(scene);
    if (hash != expected)
        fail_msg("%s: 0x%016llx", scene->name, (unsigned long long)hash);
}

static void bunny_has_maps_of_bumps(void **state) {
    (void)state;
    lobe_scene *scene = open_from(test_folder.path, "bunny");
    scene_check(scene);
    assert_hash(scene, 0x0e7e20cdcf80e414);
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->model, LOBE_MATERIAL_MICROFACET);
    assert_true(material->metallic == 1 && material->roughness == 1);
    const lobe_image *normals = image_of(scene, &material->normal_map, 1024, 1024);
    const lobe_image *matter = image_of(scene, &material->metallic_roughness_map, 1024, 1024);
    image_of(scene, &material->base_colour_map, 1024, 1024);
    assert_tiles(normals);
    assert_tiles(matter);
    normal_statistics found = scene_check_normal_map(normals);
    assert_true(found.greatest_tilt > 50 && found.mean_tilt > 20);
    // Both metal and lacquer, in comparable parts.
    size_t metal = 0;
    for (size_t i = 0; i < 1024 * 1024; i++) {
        uint8_t metallic = ((const uint8_t *)matter->texels)[4 * i + 2];
        assert_true(metallic == 0 || metallic == 255);
        metal += metallic == 255;
    }
    assert_in_range(metal, 1024 * 1024 * 3 / 10, 1024 * 1024 * 8 / 10);
    assert_true(fabsf(scene->maximum[1] - 0.2f) < 1e-6f && scene->minimum[1] == 0);
    lobe_scene_destroy(&scene);
}

static void dragon_has_scales_and_patina(void **state) {
    (void)state;
    lobe_scene *scene = open_from(test_folder.path, "dragon");
    scene_check(scene);
    assert_hash(scene, 0x25f62b121dd1e7be);
    const lobe_material *material = &scene->materials[0];
    const lobe_image *normals = image_of(scene, &material->normal_map, 2048, 2048);
    const lobe_image *matter = image_of(scene, &material->metallic_roughness_map, 671, 457);
    assert_tiles(normals);
    assert_tiles(matter);
    assert_tiles(image_of(scene, &material->base_colour_map, 671, 457));
    normal_statistics found = scene_check_normal_map(normals);
    assert_true(fabs(found.mean[0]) < 0.02);
    assert_true(found.mean_tilt > 10 && found.mean_tilt < 35 && found.greatest_tilt < 65);
    size_t bare = 0, covered = 0;
    const uint8_t *texel = matter->texels;
    for (size_t i = 0; i < 671 * 457; i++) {
        bare += texel[4 * i + 2] == 255;
        covered += texel[4 * i + 2] == 0;
        // Patina is dull.
        assert_true(texel[4 * i + 2] > 0 || texel[4 * i + 1] > 180);
    }
    assert_in_range(bare, 671 * 457 * 4 / 10, 671 * 457 * 8 / 10);
    assert_in_range(covered, 671 * 457 / 10, 671 * 457 * 4 / 10);
    lobe_scene_destroy(&scene);
}

static void assert_not_found(const char *name, const char *assets, const char *file) {
    log_recorder recorder;
    log_recorder_start(&recorder);
    lobe_scene *scene = (lobe_scene *)&scene;
    assert_int_equal(scene_list_open(name, assets, false, &recorder.host, &scene),
                     LOBE_ERROR_NOT_FOUND);
    assert_null(scene);
    assert_int_equal(recorder.errors, 1);
    assert_non_null(strstr(recorder.last_error, name));
    assert_non_null(strstr(recorder.last_error, file));
    assert_non_null(strstr(recorder.last_error, "--assets DIR or LOBE_ASSETS"));
}

static void the_list_has_the_builtin_scenes_and_the_programs_own(void **state) {
    (void)state;
    const size_t builtin = lobe_builtin_scene_count();
    static const struct {
        const char *name, *filter;
    } own[] = {{"bunny", "moments"},   {"dragon", "moments"},    {"rain", "moments"},
               {"cloth", "moments"},   {"ocean", "leadr"},       {"fields", "moments"},
               {"flag", "leadr"},      {"twill", "displaced"},   {"cobbles", "displaced"},
               {"studs", "displaced"}, {"furnace", "displaced"}, {"terrain", "leadr"}};
    assert_int_equal(scene_list_count(), builtin + sizeof own / sizeof *own);
    for (size_t i = 0; i < scene_list_count(); i++) {
        const listed_scene scene = scene_list_get(i);
        const bool animal = i == builtin || i == builtin + 1;
        assert_string_equal(scene.name,
                            i < builtin ? lobe_builtin_scene_get(i)->name : own[i - builtin].name);
        assert_true(strlen(scene.summary) > 20 && !strchr(scene.summary, '\n'));
        assert_int_equal(scene.needs_assets, animal);
        assert_int_equal(scene_list_needs_assets(scene.name), animal);
        assert_string_equal(scene_list_filter(scene.name),
                            i < builtin ? "moments" : own[i - builtin].filter);
    }
    assert_string_equal(scene_list_filter("teapot"), "moments");
    assert_string_equal(scene_list_filter(NULL), "moments");
    assert_false(scene_list_needs_assets("teapot"));
    assert_false(scene_list_needs_assets(""));
}

static void without_assets_they_are_not_found(void **state) {
    (void)state;
    assert_not_found("bunny", NULL, bunny_file);
    assert_not_found("dragon", NULL, dragon_file);
    assert_not_found("bunny", "/nonexistent", "/nonexistent/models/npm_bunny.js");
    assert_not_found("dragon", "", "/models/npm_dragon");
    // The library does not know them, and other scenes need no assets.
    lobe_scene *scene;
    assert_int_equal(lobe_scene_open("bunny", NULL, &scene), LOBE_ERROR_NOT_FOUND);
    scene = open_from("/nonexistent", "bumps");
    lobe_scene_destroy(&scene);
}

#define WITH_ASSETS(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_ASSETS(bunny_has_maps_of_bumps),
        WITH_ASSETS(dragon_has_scales_and_patina),
        cmocka_unit_test(the_list_has_the_builtin_scenes_and_the_programs_own),
        cmocka_unit_test(without_assets_they_are_not_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
