// Slopes of heights over surfaces on which their map is stretched and sheared, or which are curved:
// against normals of the surface's own formula, against maps that are stretched themselves, and
// against the same relief as a mesh of its own.

#include <math.h>
#include <stdlib.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

// ---------------------------------------------------------------------------------------------
// Waves

/// A height of `level` plus sines over the map, which repeat.
typedef struct wave {
    int u, v; ///< periods in a map
    double amplitude, phase;
} wave;

typedef struct wave_field {
    double level;
    size_t count;
    wave waves[24];
} wave_field;

/// `gradient`: per u and v.
static double field_at(const wave_field *field, double u, double v, double gradient[2]) {
    double height = field->level;
    gradient[0] = gradient[1] = 0;
    for (size_t i = 0; i < field->count; i++) {
        const wave *w = &field->waves[i];
        const double angle = 2 * M_PI * (w->u * u + w->v * v) + w->phase;
        height += w->amplitude * sin(angle);
        gradient[0] += 2 * M_PI * w->u * w->amplitude * cos(angle);
        gradient[1] += 2 * M_PI * w->v * w->amplitude * cos(angle);
    }
    return height;
}

static lobe_image field_map(const wave_field *field, uint32_t width, uint32_t height) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    double gradient[2];
    for (uint32_t i = 0; i < width * height; i++)
        ((float *)image.texels)[4 * i] = (float)field_at(
            field, (i % width + 0.5) / width, (i / width + 0.5) / height, gradient); // NOLINT
    return image;
}

static lobe_material relief(lobe_scene *scene, lobe_image heights, double scale, double metallic) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, metallic);
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = (float)scale;
    return material;
}

// ---------------------------------------------------------------------------------------------
// A torus

enum { COLUMNS = 160, ROWS = 96, EXTENT = 128 };
static const double ring = 1, tube = 0.4;
/// Of the map's coordinates, from turns around the axis and around the tube: stretched and sheared.
static const double shear[2][2] = {{4, 1}, {1, 2}};

static const wave_field torus_waves = {0.5, 2, {{1, 0, 0.22, 0.3}, {1, 2, 0.12, 1.1}}};

/// Of angles around the axis and around the tube, at a distance from the tube's centre.
static void torus_point(const double angles[2], double radius, double position[3],
                        double normal[3]) {
    const double c = cos(angles[1]);
    const double n[3] = {c * cos(angles[0]), sin(angles[1]), c * sin(angles[0])};
    for (int i = 0; i < 3; i++) {
        normal[i] = n[i];
        position[i] =
            radius * n[i] + (i == 0 ? ring * cos(angles[0]) : (i == 2 ? ring * sin(angles[0]) : 0));
    }
}

static lobe_mesh torus_mesh(void) {
    lobe_mesh mesh;
    assert_int_equal(
        scenes_mesh_allocate(&mesh, "torus", (COLUMNS + 1) * (ROWS + 1), 6 * COLUMNS * ROWS, NULL),
        LOBE_OK);
    for (uint32_t i = 0; i < (COLUMNS + 1) * (ROWS + 1); i++) {
        const double turns[2] = {(double)(i % (COLUMNS + 1)) / COLUMNS, // NOLINT
                                 (double)(i / (COLUMNS + 1)) / ROWS};   // NOLINT
        const double angles[2] = {2 * M_PI * turns[0], 2 * M_PI * turns[1]};
        double position[3], normal[3];
        torus_point(angles, tube, position, normal);
        lobe_scene_vertex *vertex = &mesh.vertices[i];
        *vertex =
            (lobe_scene_vertex){.tangent = {(float)-sin(angles[0]), 0, (float)cos(angles[0]), -1},
                                .colour = {1, 1, 1, 1}};
        for (int k = 0; k < 3; k++) {
            vertex->position[k] = (float)position[k];
            vertex->normal[k] = (float)normal[k];
        }
        for (int k = 0; k < 2; k++)
            vertex->texture_coordinates[0][k] =
                (float)(shear[k][0] * turns[0] + shear[k][1] * turns[1]);
    }
    scenes_shape_grid_indices(ROWS, COLUMNS, mesh.indices);
    mesh.has_texture_coordinates[0] = true;
    scenes_mesh_compute_bounds(&mesh);
    return mesh;
}

/// The mean of |S_u| over the torus: S_u = S_a a_u + S_b b_u, which are perpendicular.
static double torus_map_width(void) {
    const double determinant = shear[0][0] * shear[1][1] - shear[0][1] * shear[1][0];
    const double a_u = 2 * M_PI * shear[1][1] / determinant,
                 b_u = -2 * M_PI * shear[1][0] / determinant;
    double sum = 0, area = 0;
    for (int i = 0; i < 1000; i++) {
        const double across = ring + tube * cos(2 * M_PI * i / 1000);
        sum += across * hypot(across * a_u, tube * b_u);
        area += across;
    }
    return sum / area;
}

/// d/da and d/db of a surface, crossed. `relief`: metres; `lifted`: heights move its points.
static void torus_normal(const double angles[2], double relief, bool lifted, double normal[3]) {
    const double turns[2] = {angles[0] / (2 * M_PI), angles[1] / (2 * M_PI)};
    double g[2], point[3], n[3], of[2][3];
    const double height =
        relief * field_at(&torus_waves, shear[0][0] * turns[0] + shear[0][1] * turns[1],
                          shear[1][0] * turns[0] + shear[1][1] * turns[1], g);
    torus_point(angles, tube, point, n);
    const double radius = tube + (lifted ? height : 0);
    const double across = ring + radius * cos(angles[1]);
    for (int k = 0; k < 2; k++) {
        const double slope = relief * (g[0] * shear[0][k] + g[1] * shear[1][k]) / (2 * M_PI);
        const double along[2][3] = {{-across * sin(angles[0]), 0, across * cos(angles[0])},
                                    {-radius * sin(angles[1]) * cos(angles[0]),
                                     radius * cos(angles[1]),
                                     -radius * sin(angles[1]) * sin(angles[0])}};
        for (int i = 0; i < 3; i++)
            of[k][i] = along[k][i] + slope * n[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = of[1][j] * of[0][k] - of[1][k] * of[0][j];
    }
    const double size = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int i = 0; i < 3; i++)
        normal[i] /= size;
}

typedef struct torus_errors {
    double mean, flat; ///< angles between normals; of those of the torus itself
    double height;     ///< largest error of it, over the relief
} torus_errors;

/// What a picture from above shows, where it is not seen at a low angle.
static torus_errors torus_errors_of(const lobe_image *normal_depth, const lobe_camera *camera,
                                    double relief, bool displaced, bool lifted) {
    torus_errors errors = {0};
    size_t count = 0;
    for (uint32_t y = 0; y < EXTENT; y++) {
        for (uint32_t x = 0; x < EXTENT; x++) {
            const float *pixel = pixel_at(normal_depth, x, y);
            const double metres = (double)camera->orthographic_height / EXTENT;
            const double px = (x + 0.5 - EXTENT / 2) * metres, // NOLINT
                pz = (y + 0.5 - EXTENT / 2) * metres,          // NOLINT
                py = (double)camera->eye[1] - (double)pixel[3];
            const double angles[2] = {atan2(pz, px), atan2(py, hypot(px, pz) - ring)};
            double expected[3], point[3], smooth[3], g[2];
            torus_point(angles, tube, point, smooth);
            if (pixel[3] <= 0 || smooth[1] < 0.6)
                continue;
            torus_normal(angles, relief, lifted, expected);
            const double height = hypot(hypot(px, pz) - ring, py) - tube;
            const double turns[2] = {angles[0] / (2 * M_PI), angles[1] / (2 * M_PI)};
            const double wanted =
                displaced ? relief * field_at(&torus_waves,
                                              shear[0][0] * turns[0] + shear[0][1] * turns[1],
                                              shear[1][0] * turns[0] + shear[1][1] * turns[1], g)
                          : 0;
            double cosine = 0, flat = 0;
            for (int i = 0; i < 3; i++) {
                cosine += (double)pixel[i] * expected[i];
                flat += smooth[i] * expected[i];
            }
            errors.mean += acos(fmin(cosine, 1));
            errors.flat += acos(fmin(flat, 1));
            errors.height = fmax(errors.height, fabs(height - wanted) / relief);
            ++count;
        }
    }
    assert_true(count > 2000);
    errors.mean /= (double)count;
    errors.flat /= (double)count;
    return errors;
}

/// Drawn displaced, with the curvature of the torus; and flat, without (Eq. 12). Measured: 0.003
/// radians; with the other of both 0.037, the torus itself 0.2.
static void normals_are_those_of_a_torus_with_relief(void **state) {
    fixture *f = *state;
    static const char *const filters[] = {"direct", "leadr", "toksvig"};
    const double scale = 0.1, height = scale * torus_map_width();
    lobe_scene *scene = scene_begin();
    const lobe_material material = relief(scene, field_map(&torus_waves, 512, 512), scale, 0);
    lobe_mesh mesh = torus_mesh();
    add_instance_of(scene, &mesh, &material, NULL);
    scene_look_down(scene, 3.2);
    scene_end(scene);
    for (size_t i = 0; i < 2 * sizeof filters / sizeof *filters; i++) {
        const bool displaced = i % 2 == 0;
        const picture_request request = {
            .filter = filters[i / 2],
            .settings = {"pixels_per_vertex=1",
                         displaced ? "displacement=geometry" : "displacement=none"},
            .width = EXTENT,
            .height = EXTENT,
            .outputs = true};
        lobe_frame frame = draw_scene(f, scene, &request);
        const torus_errors errors =
            torus_errors_of(&frame.normal_depth, &scene->camera, height, displaced, displaced);
        const torus_errors other =
            torus_errors_of(&frame.normal_depth, &scene->camera, height, displaced, !displaced);
        if (errors.mean > 0.005 || errors.height > 0.02)
            fail_msg("%s: %g radians, heights %g", filters[i / 2], errors.mean, errors.height);
        assert_true(errors.flat > 0.15 && other.mean > 0.03);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Planes

/// How a map lies on a square from -1 to 1 m: coordinates are `rows` times (x, z) in [0, 1].
typedef struct plane_case {
    const char *name;
    double rows[2][2];
    uint32_t width, height; ///< texels
    double scale;           ///< of heights
    const float *transform;
    double joint; ///< factor of x by a joint; 0: none
} plane_case;

static void deform(lobe_mesh *mesh, double factor) {
    lobe_deformation *d = lobe_allocate(NULL, 1, sizeof *d);
    assert_non_null(d);
    d->influences_per_vertex = 1;
    d->joint_count = 1;
    d->influences = lobe_allocate(NULL, mesh->vertex_count, sizeof *d->influences);
    d->joint_matrices = lobe_allocate(NULL, 1, sizeof *d->joint_matrices);
    assert_true(d->influences && d->joint_matrices);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        d->influences[i].weight = 1;
    for (int i = 0; i < 4; i++)
        d->joint_matrices[0][5 * i] = i == 0 ? (float)factor : 1;
    mesh->deformation = d;
}

/// A field over the square itself, in a map that the case stretches.
static lobe_scene *plane_scene(const plane_case *c, const wave_field *on_plane, double metallic) {
    // Waves over the plane, in the map's coordinates: their covector times the inverse of `rows`.
    const double determinant = c->rows[0][0] * c->rows[1][1] - c->rows[0][1] * c->rows[1][0];
    wave_field field = *on_plane;
    for (size_t i = 0; i < field.count; i++) {
        const wave *w = &on_plane->waves[i];
        const double u = (w->u * c->rows[1][1] - w->v * c->rows[1][0]) / determinant,
                     v = (w->v * c->rows[0][0] - w->u * c->rows[0][1]) / determinant;
        field.waves[i].u = (int)lround(u);
        field.waves[i].v = (int)lround(v);
        assert_float_equal(u, field.waves[i].u, 1e-6);
        assert_float_equal(v, field.waves[i].v, 1e-6);
    }
    lobe_scene *scene = scene_begin();
    const lobe_material material =
        relief(scene, field_map(&field, c->width, c->height), c->scale, metallic);
    scene_add_square(scene, &material, 1, c->transform);
    lobe_mesh *mesh = &scene->meshes[0];
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lobe_scene_vertex *vertex = &mesh->vertices[i];
        const double x = 0.5 * (double)vertex->position[0], z = 0.5 * (double)vertex->position[2];
        for (int k = 0; k < 2; k++)
            vertex->texture_coordinates[0][k] = (float)(c->rows[k][0] * x + c->rows[k][1] * z);
        // No frame that would belong to the coordinates.
        vertex->tangent[0] = 0.6f;
        vertex->tangent[2] = 0.8f;
    }
    if (c->joint > 0)
        deform(mesh, c->joint);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 3);
    return scene;
}

static const wave_field plane_waves = {
    0.5, 3, {{4, 4, 0.2, 0.5}, {8, -4, 0.1, 2}, {4, 12, 0.06, 4}}};

static lobe_frame draw_plane(fixture *f, const plane_case *c, const char *filter, bool displaced,
                             double seen) {
    lobe_scene *scene = plane_scene(c, &plane_waves, 0);
    scene_look_from(scene, (double[]){0.2, 0.7, 0.5}, seen);
    scene_end(scene);
    const picture_request request = {
        .filter = filter,
        .settings = {displaced ? "displacement=geometry" : "displacement=none"},
        .width = 48,
        .height = 48,
        .samples = 4};
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_scene_destroy(&scene);
    return frame;
}

/// The first of two cases is the map that is not stretched. Close up, all filters see single texels
/// and two are drawn. From afar, the other map has larger texels, and its pixels see another level.
static void compare_planes(fixture *f, const plane_case cases[2], bool displaced, bool afar) {
    static const char *const filters[2][4] = {{"reference", "leadr", NULL},
                                              {"leadr", "multi_leadr", "toksvig", NULL}};
    const double seen = afar ? 1 : 0.3;
    for (size_t i = 0; filters[afar][i]; i++) {
        const char *filter = filters[afar][i];
        lobe_frame expected = draw_plane(f, &cases[0], filter, displaced, seen);
        lobe_frame found = draw_plane(f, &cases[1], filter, displaced, seen);
        const double error = relative_l2(&found.radiance, &expected.radiance);
        if (error > (afar ? 0.08 : 0.02))
            fail_msg("%s, %s, %g m: %g", cases[1].name, filter, seen, error);
        lobe_frame_free(&expected);
        lobe_frame_free(&found);
    }
}

static void stretched_coordinates_equal_stretched_maps(void **state) {
    static const float wide[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    // |S_u| of `rows` R is 2 |column 0 of R^-1|.
    const plane_case cases[][2] = {
        {{"", {{1, 0}, {0, 1}}, 512, 512, 0.05, NULL, 0},
         {"flat texels", {{1, 0}, {0, 1}}, 512, 128, 0.05, NULL, 0}},
        {{"", {{1, 0}, {0, 1}}, 256, 256, 0.05, NULL, 0},
         {"stretched 4:1", {{4, 0}, {0, 1}}, 128, 256, 0.2, NULL, 0}},
        {{"", {{1, 0}, {0, 1}}, 256, 256, 0.05, NULL, 0},
         {"sheared", {{1, 1}, {0, 1}}, 256, 256, 0.05, NULL, 0}},
        {{"", {{1, 0}, {0, 1}}, 256, 256, 0.05, NULL, 0},
         {"turned and mirrored", {{0, 1}, {1, 0}}, 256, 256, 0.05, NULL, 0}},
        {{"", {{1, 0}, {0, 1}}, 256, 256, 0.05, wide, 0},
         {"stretched by a joint", {{1, 0}, {0, 1}}, 256, 256, 0.05, NULL, 2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        compare_planes(*state, cases[i], false, false);
        compare_planes(*state, cases[i], i % 2 == 1, true);
    }
}

// ---------------------------------------------------------------------------------------------
// The relief as a mesh

enum { QUADS = 400 };

/// The relief of a case, with normals of its formula, of a material without maps.
static lobe_scene *mesh_scene(const plane_case *c, const wave_field *field, double metallic) {
    lobe_scene *scene = scene_begin();
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, metallic);
    lobe_mesh mesh;
    const double determinant = c->rows[0][0] * c->rows[1][1] - c->rows[0][1] * c->rows[1][0];
    const double height =
        c->scale * 2 * hypot(c->rows[1][1], c->rows[1][0]) / fabs(determinant); // times |S_u|
    assert_int_equal(
        scenes_mesh_allocate(&mesh, "relief", (QUADS + 1) * (QUADS + 1), 6 * QUADS * QUADS, NULL),
        LOBE_OK);
    for (uint32_t i = 0; i < (QUADS + 1) * (QUADS + 1); i++) {
        const double x = (double)(i % (QUADS + 1)) / QUADS, z = (double)(i / (QUADS + 1)) / QUADS;
        double g[2];
        const double h = height * field_at(field, x, z, g);
        mesh.vertices[i] = (lobe_scene_vertex){
            .position = {(float)(2 * x - 1), (float)h, (float)(2 * z - 1)},
            .normal = {(float)(-height * g[0] / 2), 1, (float)(-height * g[1] / 2)},
            .tangent = {1, 0, 0, 1},
            .colour = {1, 1, 1, 1}};
        float *n = mesh.vertices[i].normal;
        const float size = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++)
            n[k] /= size;
    }
    scenes_shape_grid_indices(QUADS, QUADS, mesh.indices);
    scenes_mesh_compute_bounds(&mesh);
    add_instance_of(scene, &mesh, &material, NULL);
    scene_add_sun(scene, (double[]){0.3, 1, 0.2}, 3);
    return scene;
}

static double mean_radiance(fixture *f, lobe_scene *scene, const char *filter, double azimuth) {
    scene_look_from(scene, (double[]){0.8 * cos(azimuth), 0.7, 0.8 * sin(azimuth)}, 0.9);
    scene_end(scene);
    const picture_request request = {.filter = filter, .width = 24, .height = 24, .samples = 16};
    lobe_frame frame = draw_scene(f, scene, &request);
    double sum = 0;
    for (uint32_t i = 0; i < 24 * 24; i++)
        sum += ((const float *)frame.radiance.texels)[4 * i + 1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return sum / (24 * 24);
}

static wave_field random_waves(void) {
    random_sequence sequence = scenes_random_start(5);
    wave_field field = {.level = 0.5, .count = 24};
    for (size_t i = 0; i < field.count; i++) {
        const double angle = scenes_random_between(&sequence, 0, 2 * M_PI);
        const double size = exp(scenes_random_between(&sequence, log(6), log(14)));
        field.waves[i] =
            (wave){(int)lround(size / 4 * cos(angle)) * 4, (int)lround(size * sin(angle)),
                   0.25 / size, scenes_random_between(&sequence, 0, 2 * M_PI)};
    }
    return field;
}

/// Mean errors are those of the map that is not stretched. Pixels of the flat plane see parts of
/// waves, all as large, whether they face the viewer or not; facets of such slopes, counted so,
/// have 0.72 and 0.74 of the light that they have by the area that they show, if they are metal.
/// Measured: diffuse -0.021, -0.011; sheared -0.015, -0.007. Metal -0.31, -0.18; sheared -0.28,
/// -0.14. With slopes that forget the stretching -0.06 and -0.6.
static void brightness_is_that_of_the_relief_itself(void **state) {
    fixture *f = *state;
    static const plane_case cases[] = {
        {"square", {{1, 0}, {0, 1}}, 256, 256, 0.08, NULL, 0},
        {"stretched 4:1", {{4, 0}, {0, 1}}, 64, 256, 0.32, NULL, 0},
        {"sheared", {{1, 1}, {0, 1}}, 256, 256, 0.08, NULL, 0},
        {"stretched and sheared", {{4, 4}, {0, 1}}, 64, 256, 0.32, NULL, 0},
    };
    static const double most[2][2] = {{0.025, 0.015}, {0.33, 0.2}};
    const wave_field field = random_waves();
    for (size_t metal = 0; metal < 2; metal++) {
        for (size_t view = 0; view < 2; view++) {
            const double azimuth = view == 0 ? 0.2 : 1.6;
            const double expected = mean_radiance(f, mesh_scene(&cases[0], &field, (double)metal),
                                                  "reference", azimuth);
            for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
                const double found = mean_radiance(f, plane_scene(&cases[i], &field, (double)metal),
                                                   "leadr", azimuth);
                if (!(fabs(found / expected - 1) < most[metal][view]))
                    fail_msg("%s, metal %zu, view %zu: %g instead of %g", cases[i].name, metal,
                             view, found, expected);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_are_those_of_a_torus_with_relief),
        cmocka_unit_test(stretched_coordinates_equal_stretched_maps),
        cmocka_unit_test(brightness_is_that_of_the_relief_itself),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
