#include "tests/engine/support/cmocka_all.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/builtin.h"
#include "scenes/mesh/vector.h"
#include "tests/scenes/scene/scene_check.h"

static lobe_scene *build(const char *name) {
    const builtin_scene *found = scenes_builtin_find(name);
    assert_non_null(found);
    lobe_scene *scene = NULL;
    assert_int_equal(found->build(NULL, &scene), LOBE_OK);
    assert_non_null(scene);
    return scene;
}

enum { MOST_SCENES = 16 };

/// The scenes that cases have looked at, which takes seconds to build.
static lobe_scene *kept[MOST_SCENES];

/// Belongs to all cases.
static const lobe_scene *built(const char *name) {
    size_t i = 0;
    while (i < MOST_SCENES && kept[i] && strcmp(kept[i]->name, name) != 0)
        i++;
    assert_true(i < MOST_SCENES);
    if (!kept[i])
        kept[i] = build(name);
    return kept[i];
}

static int free_scenes(void **state) {
    (void)state;
    for (int i = 0; i < MOST_SCENES; i++)
        lobe_scene_destroy(&kept[i]);
    return 0;
}

static const lobe_image *image_of(const lobe_scene *scene, const lobe_texture_use *use) {
    assert_in_range(use->image, 0, scene->image_count - 1);
    return &scene->images[use->image].image;
}

static void assert_size(const lobe_image *image, lobe_format format, uint32_t width,
                        uint32_t height) {
    assert_int_equal(image->format, format);
    assert_int_equal(image->width, width);
    assert_int_equal(image->height, height);
}

static void assert_extent(const lobe_image *image, lobe_format format, uint32_t extent) {
    assert_size(image, format, extent, extent);
}

static void the_table_lists_the_scenes(void **state) {
    (void)state;
    static const char *const names[] = {"checkerboard", "bumps", "tablecloth", "pillow", "hall"};
    const size_t count = sizeof names / sizeof *names;
    assert_int_equal(lobe_builtin_scene_count(), count);
    for (size_t i = 0; i < count; i++) {
        const lobe_builtin_scene *scene = lobe_builtin_scene_get(i);
        assert_string_equal(scene->name, names[i]);
        assert_true(strlen(scene->summary) > 20 && !strchr(scene->summary, '\n'));
        assert_string_equal(scenes_builtin_find(names[i])->description.name, names[i]);
    }
    assert_null(lobe_builtin_scene_get(count));
    assert_null(scenes_builtin_find("teapot"));
    assert_null(scenes_builtin_find(""));
    lobe_scene *opened = NULL;
    assert_int_equal(lobe_scene_open("bumps", NULL, &opened), LOBE_OK);
    assert_string_equal(opened->name, "bumps");
    lobe_scene_destroy(&opened);
}

static void every_scene_is_sound(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++) {
        const char *name = lobe_builtin_scene_get(i)->name;
        const lobe_scene *scene = built(name);
        assert_string_equal(scene->name, name);
        assert_true(scene->light_count >= 2 && scene->light_count <= 4);
        scene_check(scene);
    }
}

static void building_twice_gives_the_same_bytes(void **state) {
    (void)state;
    for (size_t i = 0; i < lobe_builtin_scene_count(); i++) {
        const lobe_scene *first = built(lobe_builtin_scene_get(i)->name);
        lobe_scene *second = build(lobe_builtin_scene_get(i)->name);
        scene_check_equal(first, second);
        lobe_scene_destroy(&second);
    }
}

// Hash of the bytes that every machine and compiler must make. If you change a scene on purpose,
// change its number here; results measured before are then no longer comparable.
static void every_machine_makes_these_bytes(void **state) {
    (void)state;
    static const struct {
        const char *name;
        uint64_t hash;
    } expected[] = {
        {"checkerboard", 0x7e52d90864b27576}, {"bumps", 0xb56df8d6b67c3308},
        {"tablecloth", 0xd79e3f2d2d81abbd},   {"pillow", 0x80b5af30c8fcd972},
        {"hall", 0x8672363cbd0970fa},
    };
    int different = 0;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const lobe_scene *scene = built(expected[i].name);
        uint64_t hash = scene_check_hash(scene);
        different += hash != expected[i].hash;
        if (hash != expected[i].hash)
            print_error("%s: 0x%016llx\n", expected[i].name, (unsigned long long)hash);
    }
    assert_int_equal(different, 0);
}

static void checkerboard_has_two_widths_in_equal_parts(void **state) {
    (void)state;
    const lobe_scene *scene = built("checkerboard");
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->model, LOBE_MATERIAL_HALF_VECTOR_LOBES);
    assert_int_equal(material->distribution, LOBE_DISTRIBUTION_VMF);
    assert_int_equal(material->lobe_count, 1);
    assert_true(material->lobes[0].direction[2] == 1);
    assert_int_equal(material->normal_map.image, -1);
    assert_true(material->width_map.nearest && material->base_colour_map.nearest);
    const lobe_image *widths = image_of(scene, &material->width_map);
    const lobe_image *colours = image_of(scene, &material->base_colour_map);
    assert_extent(widths, LOBE_FORMAT_R32_FLOAT, 1024);
    assert_extent(colours, LOBE_FORMAT_RGBA8_SRGB, 1024);
    const float *texel = widths->texels;
    const uint8_t *colour = colours->texels;
    float first = texel[0], last = texel[1023];
    size_t of_first = 0, changes = 0;
    assert_true(first * 10 < last);
    for (size_t i = 0; i < 1024 * 1024; i++) {
        assert_true(texel[i] == first || texel[i] == last);
        // There is one colour for each width.
        assert_memory_equal(colour + 4 * i, texel[i] == first ? colour : colour + 4 * 1023, 4);
        of_first += texel[i] == first;
        changes += i % 1024 > 0 && texel[i] != texel[i - 1];
    }
    assert_int_equal(of_first, 1024 * 1024 / 2);
    // Squares of a few texels, so 127 edges in each row; the map repeats without a seam.
    assert_int_equal(changes, 1024 * 127);
    assert_true(texel[1023] != texel[0] && texel[1024 * 1023] != texel[0]);
}

// Counts the texels, and sums the squared differences of neighbours, within a map and across its
// edges.
static double step_over_edge(const lobe_image *image, bool rows, bool edge) {
    const uint8_t *texels = image->texels;
    uint32_t extent = rows ? image->height : image->width;
    uint32_t count = rows ? image->width : image->height;
    size_t stride = image->width;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = edge ? extent - 1 : extent / 3, b = edge ? 0 : extent / 3 + 1;
        size_t from = (rows ? a * stride + i : i * stride + a) * 4;
        size_t to = (rows ? b * stride + i : i * stride + b) * 4;
        for (int channel = 0; channel < 3; channel++)
            sum += pow(texels[from + channel] - texels[to + channel], 2);
    }
    return sqrt(sum / count);
}

// At a mismatched edge, the difference would be far larger than between neighbours elsewhere.
static void assert_tiles(const lobe_image *image) {
    for (int rows = 0; rows < 2; rows++)
        assert_true(step_over_edge(image, rows, true) < 1.6 * step_over_edge(image, rows, false));
}

static void bumps_are_packed_hemispheres_of_many_metals(void **state) {
    (void)state;
    const lobe_scene *scene = built("bumps");
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->model, LOBE_MATERIAL_MICROFACET);
    assert_int_equal(material->distribution, LOBE_DISTRIBUTION_GGX);
    assert_true(material->metallic == 1 && material->roughness == 1);
    const lobe_image *normals = image_of(scene, &material->normal_map);
    const lobe_image *roughness = image_of(scene, &material->metallic_roughness_map);
    assert_extent(normals, LOBE_FORMAT_RGBA8_UNORM, 1024);
    assert_extent(roughness, LOBE_FORMAT_RGBA8_UNORM, 1024);
    assert_extent(image_of(scene, &material->base_colour_map), LOBE_FORMAT_RGBA8_SRGB, 1024);
    normal_statistics found = scene_check_normal_map(normals);
    assert_true(fabs(found.mean[0]) < 0.01 && fabs(found.mean[1]) < 0.01);
    assert_true(found.greatest_tilt > 50 && found.greatest_tilt < 60);
    assert_true(found.mean_tilt > 20 && found.mean_tilt < 35);
    assert_tiles(normals);
    assert_tiles(roughness);
    int values[256] = {0}, distinct = 0;
    const uint8_t *texel = roughness->texels;
    for (size_t i = 0; i < 1024 * 1024; i++) {
        values[texel[4 * i + 1]]++;
        assert_int_equal(texel[4 * i + 2], 255);
    }
    for (int i = 0; i < 256; i++)
        distinct += values[i] > 0;
    assert_true(distinct > 60);
    // Bumps cover most of the plane.
    assert_true(values[128] < 1024 * 1024 / 4);
}

// On a sphere, the normal's x grows with the column as fast as its -y grows with the row.
static void bumps_are_round(void **state) {
    (void)state;
    const lobe_scene *scene = built("bumps");
    const lobe_image *normals = image_of(scene, &scene->materials[0].normal_map);
    const uint8_t *texel = normals->texels;
    int inside = 0, round = 0;
    for (size_t row = 0; row + 1 < 1024; row++)
        for (size_t column = 0; column + 1 < 1024; column++) {
            const uint8_t *here = texel + (row * 1024 + column) * 4;
            int along_column = here[4] - here[0], along_row = here[4 * 1024 + 1] - here[1];
            int across = abs(here[5] - here[1]);
            // Neighbours on one bump: the component across is constant.
            if (across > 1 || along_column < 1 || along_column > 16)
                continue;
            inside++;
            round += abs(along_column + along_row) <= 2;
        }
    assert_true(inside > 400000);
    assert_true(round > inside * 9 / 10);
}

static void tablecloth_has_two_lobes_at_45_degrees(void **state) {
    (void)state;
    const lobe_scene *scene = built("tablecloth");
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->model, LOBE_MATERIAL_HALF_VECTOR_LOBES);
    assert_int_equal(material->distribution, LOBE_DISTRIBUTION_VMF);
    assert_int_equal(material->lobe_count, 2);
    for (int i = 0; i < 2; i++) {
        const lobe_base_lobe *lobe = &material->lobes[i];
        assert_true(fabs(lobe->direction[0] - (i ? -sqrt(0.5) : sqrt(0.5))) < 1e-7);
        assert_true(lobe->direction[1] == 0);
        assert_true(fabs(lobe->direction[2] - sqrt(0.5)) < 1e-7);
        assert_true(lobe->width == 128);
        assert_memory_equal(lobe->colour, material->lobes[0].colour, sizeof lobe->colour);
    }
    assert_int_equal(material->width_map.image, -1);
    const lobe_image *normals = image_of(scene, &material->normal_map);
    assert_extent(normals, LOBE_FORMAT_RGBA8_UNORM, 1024);
    normal_statistics found = scene_check_normal_map(normals);
    assert_true(fabs(found.mean[0]) < 0.01 && fabs(found.mean[1]) < 0.01);
    assert_true(found.mean_tilt > 8 && found.mean_tilt < 20);
    assert_true(found.greatest_tilt > 25 && found.greatest_tilt < 45);
    assert_tiles(normals);
}

static double distance(const float a[3], const float b[3]) {
    return vector3_length(vector3_subtract(vector3_load(a), vector3_load(b)));
}

static void tablecloth_lies_on_its_table(void **state) {
    (void)state;
    const lobe_scene *scene = built("tablecloth");
    const lobe_mesh *mesh = &scene->meshes[0];
    assert_in_range(mesh->index_count / 3, 20000, 60000);
    size_t flat = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position;
        double radius = sqrt((double)p[0] * p[0] + (double)p[2] * p[2]);
        assert_true(p[1] > 0 && p[1] <= 0.8f);
        // The hanging cloth does not pass through the table.
        assert_true(p[1] > 0.8f - 0.04f || radius > 0.6 - 1e-6);
        flat += p[1] == 0.8f;
    }
    assert_in_range(flat, mesh->vertex_count / 4, mesh->vertex_count / 3);
    // Woven cloth hardly stretches or shrinks along the fall; it gathers across it.
    for (size_t i = 0; i < mesh->index_count; i += 3)
        for (int k = 0; k < 3; k++) {
            const lobe_scene_vertex *a = &mesh->vertices[mesh->indices[i + k]];
            const lobe_scene_vertex *b = &mesh->vertices[mesh->indices[i + (k + 1) % 3]];
            double u = a->texture_coordinates[0][0] - b->texture_coordinates[0][0];
            double v = a->texture_coordinates[0][1] - b->texture_coordinates[0][1];
            double flat_length = sqrt(u * u + v * v) / 14 * 1.9;
            double ratio = distance(a->position, b->position) / flat_length;
            assert_true(ratio > 0.3 && ratio < 1.25);
        }
    assert_true(mesh->vertices[mesh->vertex_count - 1].texture_coordinates[0][0] > 2);
}

typedef struct projection {
    vector3 eye, right, up, forward;
    double scale; // pixels at distance 1
} projection;

static projection look(const lobe_camera *camera) {
    projection made = {.eye = vector3_load(camera->eye)};
    made.forward = vector3_subtract(vector3_load(camera->target), made.eye);
    vector3_normalise(&made.forward, 0);
    made.right = vector3_cross(made.forward, vector3_load(camera->up));
    vector3_normalise(&made.right, 0);
    made.up = vector3_cross(made.right, made.forward);
    made.scale = 360 / tan(camera->vertical_field_of_view / 2);
    return made;
}

// False outside the picture of 1280 x 720 pixels.
static bool project(const projection *view, const float position[3], double pixel[2]) {
    vector3 offset = vector3_subtract(vector3_load(position), view->eye);
    double depth = vector3_dot(offset, view->forward);
    if (depth <= 0)
        return false;
    pixel[0] = 640 + view->scale * vector3_dot(offset, view->right) / depth;
    pixel[1] = 360 - view->scale * vector3_dot(offset, view->up) / depth;
    return pixel[0] >= 0 && pixel[0] <= 1280 && pixel[1] >= 0 && pixel[1] <= 720;
}

static double area(double a[2], double b[2], double c[2]) {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

typedef struct coverage {
    double seen;    // pixels
    double fitting; // of them, those with a number of texels in the range
} coverage;

// Measures front faces of a mesh that lie in the picture; one unit of the coordinates is a map of
// `width` x `height` texels. Texels per pixel are counted along one axis of the pixel.
static coverage measure_texels(const lobe_scene *scene, const lobe_instance *instance, double width,
                               double height, double least, double most) {
    const lobe_mesh *mesh = &scene->meshes[instance->mesh];
    projection view = look(&scene->camera);
    coverage found = {0};
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        double pixel[3][2] = {{0}}, texel[3][2];
        bool inside = true;
        for (int k = 0; k < 3; k++) {
            const lobe_scene_vertex *vertex = &mesh->vertices[mesh->indices[i + k]];
            float position[3];
            vector3_store(vector3_transform(instance->transform, vector3_load(vertex->position)),
                          position);
            inside &= project(&view, position, pixel[k]);
            texel[k][0] = vertex->texture_coordinates[0][0] * width;
            texel[k][1] = vertex->texture_coordinates[0][1] * height;
        }
        // Rows of pixels run downwards, so a front face is clockwise.
        double pixels = -area(pixel[0], pixel[1], pixel[2]);
        if (!inside || pixels <= 0)
            continue;
        double texels_a_pixel = sqrt(fabs(area(texel[0], texel[1], texel[2])) / pixels);
        found.seen += pixels;
        if (texels_a_pixel > least && texels_a_pixel < most)
            found.fitting += pixels;
    }
    return found;
}

static void tablecloth_fills_the_picture_with_small_texels(void **state) {
    (void)state;
    const lobe_scene *scene = built("tablecloth");
    coverage found = measure_texels(scene, &scene->instances[0], 1024, 1024, 2, 16);
    assert_true(found.seen > 0.6 * 1280 * 720);
    assert_true(found.fitting > 0.9 * found.seen);
}

static void pillow_is_woven_of_sharp_and_broad_threads(void **state) {
    (void)state;
    const lobe_scene *scene = built("pillow");
    const lobe_material *material = &scene->materials[0];
    assert_int_equal(material->model, LOBE_MATERIAL_HALF_VECTOR_LOBES);
    assert_int_equal(material->distribution, LOBE_DISTRIBUTION_BLINN_PHONG);
    assert_int_equal(material->lobe_count, 1);
    assert_true(material->lobes[0].direction[2] == 1 && material->lobes[0].width == 1);
    const lobe_image *exponents = image_of(scene, &material->width_map);
    const lobe_image *specular = image_of(scene, &material->specular_map);
    assert_size(exponents, LOBE_FORMAT_R32_FLOAT, 2048, 1024);
    assert_size(specular, LOBE_FORMAT_RGBA8_SRGB, 2048, 1024);
    assert_size(image_of(scene, &material->base_colour_map), LOBE_FORMAT_RGBA8_SRGB, 2048, 1024);
    const lobe_image *normals = image_of(scene, &material->normal_map);
    assert_size(normals, LOBE_FORMAT_RGBA8_UNORM, 2048, 1024);
    const float *exponent = exponents->texels;
    const uint8_t *colour = specular->texels, *normal = normals->texels;
    size_t sharp = 0;
    double tilts[2] = {0};
    for (size_t i = 0; i < 2048 * 1024; i++) {
        // Two kinds of thread, far apart in both parameters.
        bool is_sharp = exponent[i] > 100;
        assert_true(is_sharp ? exponent[i] < 200 : exponent[i] > 5 && exponent[i] < 12);
        assert_true(is_sharp == (colour[4 * i + 2] > 0.7 * colour[4 * i]));
        sharp += is_sharp;
        // All texels of a crossing of threads show the thread on top.
        assert_true(is_sharp == (exponent[i & ~(size_t)3] > 100));
        tilts[is_sharp] += hypot(normal[4 * i] / 127.5 - 1, normal[4 * i + 1] / 127.5 - 1);
    }
    assert_in_range(sharp, 2048 * 1024 * 5 / 10, 2048 * 1024 * 7 / 10);
    // Round gold, flatter silk, to either side of the split of clusters at 12 degrees.
    tilts[0] /= (double)(2048 * 1024 - sharp);
    tilts[1] /= (double)sharp;
    assert_true(tilts[0] > 0.25 && tilts[0] < 0.45 && tilts[1] > 0.06 && tilts[1] < 0.15);
}

static void pillow_is_a_closed_cushion_on_the_ground(void **state) {
    (void)state;
    const lobe_scene *scene = built("pillow");
    const lobe_mesh *upper = &scene->meshes[0], *lower = &scene->meshes[1];
    assert_int_equal(upper->vertex_count, lower->vertex_count);
    size_t side = (size_t)(sqrt((double)upper->vertex_count) + 0.5), seam = 0;
    for (size_t i = 0; i < upper->vertex_count; i++) {
        size_t row = i / side, column = i % side;
        const float *above = upper->vertices[i].position;
        const float *below = lower->vertices[row * side + side - 1 - column].position;
        assert_true(fabsf(above[0] - below[0]) < 1e-6f && fabsf(above[2] - below[2]) < 1e-6f);
        bool edge = row == 0 || row == side - 1 || column == 0 || column == side - 1;
        assert_true(edge ? fabsf(above[1] - below[1]) < 1e-6f : above[1] > below[1]);
        seam += edge;
    }
    assert_int_equal(seam, 4 * (side - 1));
    assert_true(upper->maximum[1] > 0.08f && upper->maximum[0] < 0.25f);
    float ground = scene->instances[0].transform[13] + lower->minimum[1];
    assert_true(ground > -0.005f && ground < 0.002f);
}

static void pillow_has_several_texels_under_a_pixel(void **state) {
    (void)state;
    const lobe_scene *scene = built("pillow");
    coverage found = measure_texels(scene, &scene->instances[0], 2048, 1024, 3, 10);
    assert_true(found.seen > 0.25 * 1280 * 720);
    assert_true(found.fitting > 0.9 * found.seen);
}

static void hall_has_five_materials(void **state) {
    (void)state;
    static const struct {
        const char *name;
        uint32_t normals, others; // texels per side
    } expected[] = {{"floor", 2048, 1024},
                    {"masonry", 512, 512},
                    {"marble", 512, 512},
                    {"bronze", 512, 512},
                    {"cloth", 512, 512}};
    const lobe_scene *scene = built("hall");
    assert_int_equal(scene->material_count, 5);
    for (size_t i = 0; i < 5; i++) {
        const lobe_material *material = &scene->materials[i];
        assert_string_equal(material->name, expected[i].name);
        bool cloth = i == 4;
        assert_int_equal(material->model,
                         cloth ? LOBE_MATERIAL_HALF_VECTOR_LOBES : LOBE_MATERIAL_MICROFACET);
        assert_int_equal(material->distribution,
                         cloth ? LOBE_DISTRIBUTION_BLINN_PHONG : LOBE_DISTRIBUTION_GGX);
        const lobe_image *normals = image_of(scene, &material->normal_map);
        assert_extent(normals, LOBE_FORMAT_RGBA8_UNORM, expected[i].normals);
        normal_statistics found = scene_check_normal_map(normals);
        assert_true(fabs(found.mean[0]) < 0.01 && fabs(found.mean[1]) < 0.01);
        assert_true(found.mean_tilt > 1 && found.greatest_tilt > 10);
        assert_extent(image_of(scene, &material->base_colour_map), LOBE_FORMAT_RGBA8_SRGB,
                      expected[i].others);
        const lobe_texture_use *width =
            cloth ? &material->width_map : &material->metallic_roughness_map;
        assert_extent(image_of(scene, width),
                      cloth ? LOBE_FORMAT_R32_FLOAT : LOBE_FORMAT_RGBA8_UNORM, expected[i].others);
    }
}

static void metals_of_the_hall(void **state) {
    (void)state;
    const lobe_scene *scene = built("hall");
    double share[4];
    for (size_t i = 0; i < 4; i++) {
        const lobe_image *map = image_of(scene, &scene->materials[i].metallic_roughness_map);
        const uint8_t *texel = map->texels;
        size_t count = (size_t)map->width * map->height, metal = 0;
        for (size_t k = 0; k < count; k++) {
            // No mirrors, which no number of samples would resolve.
            assert_true(texel[4 * k + 1] > 30);
            metal += texel[4 * k + 2] > 127;
        }
        share[i] = (double)metal / (double)count;
    }
    // Brass inlays in the floor, and bronze that is mostly bare.
    assert_true(share[0] > 0.02 && share[0] < 0.1);
    assert_true(share[1] == 0 && share[2] == 0);
    assert_true(share[3] > 0.5 && share[3] < 0.95);
    for (size_t i = 2; i < 5; i++)
        assert_tiles(image_of(scene, &scene->materials[i].normal_map));
}

static void hall_draws_more_than_100000_triangles(void **state) {
    (void)state;
    const lobe_scene *scene = built("hall");
    size_t triangles = 0, of_material[5] = {0};
    for (size_t i = 0; i < scene->instance_count; i++) {
        size_t count = scene->meshes[scene->instances[i].mesh].index_count / 3;
        triangles += count;
        of_material[scene->instances[i].material] += count;
    }
    assert_in_range(triangles, 100000, 150000);
    for (size_t i = 0; i < 5; i++)
        assert_true(of_material[i] > 0);
    assert_int_equal(scene->light_count, 4);
    assert_true(scene->minimum[1] == 0 && scene->maximum[1] > 7);
}

static const lobe_mesh *mesh_named(const lobe_scene *scene, const char *name) {
    for (size_t i = 0; i < scene->mesh_count; i++)
        if (strcmp(scene->meshes[i].name, name) == 0)
            return &scene->meshes[i];
    fail_msg("no mesh '%s'", name);
    return NULL;
}

static void arches_rest_on_columns(void **state) {
    (void)state;
    const lobe_scene *scene = built("hall");
    const lobe_mesh *column = mesh_named(scene, "column"), *capital = mesh_named(scene, "capital");
    assert_true(capital->minimum[1] < column->maximum[1]);
    size_t arches = 0;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const lobe_instance *instance = &scene->instances[i];
        if (&scene->meshes[instance->mesh] != mesh_named(scene, "arch"))
            continue;
        arches++;
        // The column is half a bay to either side.
        for (int side = -1; side <= 1; side += 2) {
            size_t under = 0;
            vector3 foot = vector3_transform(instance->transform, (vector3){side * 1.8, 0, 0});
            for (size_t k = 0; k < scene->instance_count; k++) {
                const float *at = scene->instances[k].transform + 12;
                under += &scene->meshes[scene->instances[k].mesh] == column &&
                         fabs(at[0] - foot.x) < 1e-5 && fabs(at[2] - foot.z) < 1e-5;
            }
            assert_int_equal(under, 1);
            assert_true(foot.y > capital->maximum[1] && foot.y < capital->maximum[1] + 0.25);
        }
    }
    assert_int_equal(arches, 23);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_lists_the_scenes),
        cmocka_unit_test(every_scene_is_sound),
        cmocka_unit_test(building_twice_gives_the_same_bytes),
        cmocka_unit_test(every_machine_makes_these_bytes),
        cmocka_unit_test(checkerboard_has_two_widths_in_equal_parts),
        cmocka_unit_test(bumps_are_packed_hemispheres_of_many_metals),
        cmocka_unit_test(bumps_are_round),
        cmocka_unit_test(tablecloth_has_two_lobes_at_45_degrees),
        cmocka_unit_test(tablecloth_lies_on_its_table),
        cmocka_unit_test(tablecloth_fills_the_picture_with_small_texels),
        cmocka_unit_test(pillow_is_woven_of_sharp_and_broad_threads),
        cmocka_unit_test(pillow_is_a_closed_cushion_on_the_ground),
        cmocka_unit_test(pillow_has_several_texels_under_a_pixel),
        cmocka_unit_test(hall_has_five_materials),
        cmocka_unit_test(metals_of_the_hall),
        cmocka_unit_test(hall_draws_more_than_100000_triangles),
        cmocka_unit_test(arches_rest_on_columns),
    };
    return cmocka_run_group_tests(tests, NULL, free_scenes);
}
