// The distribution of half vectors that filters see under a pixel of 8 x 8 or 32 x 32 texels,
// against the mean of all texel's lobes: at centres of a level's texels and at corners between
// four, where components of neighbours that differ would blend into ones that neither has.
//
// `test_filters_mixture_map_error NORMALS[,ROUGHNESS]...` prints the same of photographed maps,
// `test_filters_mixture_map_error materials` of maps whose relief, sharpness and colour change
// together, `test_filters_mixture_map_error "fish scale" ...` of those with these names.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/format/image_file.h"
#include "tests/passes/filters/mixture/changing_materials.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 256, GRID = 15, MAXIMUM_DIRECTIONS = GRID * GRID };

/// Of base lobes where no map of roughness changes it.
static const double usual_concentration = 50;

/// Half vectors, in the tangent frame of the map.
typedef struct direction_list {
    uint32_t count;
    double directions[MAXIMUM_DIRECTIONS][3];
} direction_list;

/// A regular grid in the Lambert plane, as far as a viewer above sees half vectors of lights.
static direction_list half_vectors(void) {
    direction_list list = {0};
    for (int i = 0; i < GRID * GRID; i++) {
        const double x = 0.1 * (i % GRID - GRID / 2), y = 0.1 * (i / GRID - GRID / 2);
        const double square = x * x + y * y;
        if (square > 0.75 * 0.75)
            continue;
        double *direction = list.directions[list.count++];
        direction[0] = x * sqrt(1 - square / 4);
        direction[1] = y * sqrt(1 - square / 4);
        direction[2] = 1 - square / 2;
    }
    return list;
}

/// Numbers by half vector, then by pixel of a square picture.
typedef struct distributions {
    uint32_t side;
    double *values;
} distributions;

static distributions allocate(uint32_t side) {
    distributions result = {side, calloc((size_t)MAXIMUM_DIRECTIONS * side * side, sizeof(double))};
    assert_non_null(result.values);
    return result;
}

static double *values_of(const distributions *all, uint32_t direction) {
    return all->values + (size_t)direction * all->side * all->side;
}

static void decode(const float *texel, double normal[3]) {
    double length = 0;
    for (int i = 0; i < 3; i++) {
        normal[i] = 2 * (double)texel[i] - 1;
        length += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrt(length);
}

/// A map of normals with the concentration in the fourth channel, and the lobes' colours; NULL:
/// they are white.
typedef struct measured_map {
    lobe_image lobes;
    const lobe_image *colours;
} measured_map;

/// The mean of the lobes under each pixel.
static distributions exact_distributions(const measured_map *map, const direction_list *list,
                                         uint32_t side) {
    distributions exact = allocate(side);
    const uint32_t box = EXTENT / side;
    for (uint32_t texel = 0; texel < EXTENT * EXTENT; texel++) {
        const uint32_t pixel = texel / EXTENT / box * side + texel % EXTENT / box;
        const float *values = (const float *)map->lobes.texels + (size_t)4 * texel;
        const double colour =
            map->colours ? (double)((const float *)map->colours->texels)[texel] : 1;
        const double concentration = (double)values[3];
        const double peak = colour * concentration / (2 * M_PI * (1 - exp(-2 * concentration)));
        double normal[3];
        decode(values, normal);
        for (uint32_t i = 0; i < list->count; i++) {
            const double *h = list->directions[i];
            const double cosine = normal[0] * h[0] + normal[1] * h[1] + normal[2] * h[2];
            values_of(&exact, i)[pixel] +=
                peak * exp(concentration * (cosine - 1)) / (double)(box * box);
        }
    }
    return exact;
}

/// Concentrations as multiples of the usual one.
static lobe_image width_map(const lobe_image *map, bool *varies) {
    lobe_image widths = map_image(LOBE_FORMAT_R32_FLOAT, EXTENT, EXTENT);
    float *values = widths.texels;
    *varies = false;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        values[i] = ((const float *)map->texels)[4 * i + 3] / (float)usual_concentration;
        *varies |= values[i] != values[0];
    }
    return widths;
}

static lobe_scene *make_scene(const measured_map *measured) {
    const lobe_image *map = &measured->lobes;
    bool varies;
    lobe_scene *scene = scene_begin();
    lobe_image copy = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    lobe_image widths = width_map(map, &varies);
    memcpy(copy.texels, map->texels, (size_t)16 * EXTENT * EXTENT);
    lobe_material material =
        half_vector_material(LOBE_DISTRIBUTION_VMF, (float)usual_concentration);
    material.normal_map = scene_add_map(scene, copy);
    material.normal_map.nearest = true;
    if (varies) {
        material.width_map = scene_add_map(scene, widths);
        material.width_map.nearest = true;
    } else {
        lobe_image_free(&widths);
    }
    if (measured->colours) {
        lobe_image colours = map_image(LOBE_FORMAT_R32_FLOAT, EXTENT, EXTENT);
        memcpy(colours.texels, measured->colours->texels, (size_t)4 * EXTENT * EXTENT);
        material.specular_map = scene_add_map(scene, colours);
        material.specular_map.nearest = true;
    }
    scene_add_square(scene, &material, 1, NULL);
    scene_look_down(scene, 2);
    scene_add_sun(scene, (const double[3]){0, 1, 0}, 1);
    scene_end(scene);
    return scene;
}

/// The light whose half vector with a viewer above this is.
static void point_light(lobe_scene *scene, const double h[3]) {
    const double tangent[3] = {2 * h[2] * h[0], 2 * h[2] * h[1], 2 * h[2] * h[2] - 1};
    scene->lights[0].direction[0] = (float)-tangent[0];
    scene->lights[0].direction[1] = (float)-tangent[2];
    scene->lights[0].direction[2] = (float)tangent[1];
}

/// `corner`: half a pixel further to the right and down.
static distributions draw_distributions(fixture *f, lobe_scene *scene, const direction_list *list,
                                        const picture_request *request, bool corner) {
    distributions drawn = allocate(request->width);
    for (int i = 0; i < 2; i++)
        scene->camera.shift[i] = corner ? 0.5f / (float)request->width : 0;
    for (uint32_t i = 0; i < list->count; i++) {
        point_light(scene, list->directions[i]);
        lobe_frame frame = draw(f, request);
        for (uint32_t k = 0; k < drawn.side * drawn.side; k++)
            values_of(&drawn, i)[k] =
                (double)*pixel_at(&frame.radiance, k % drawn.side, k / drawn.side);
        lobe_frame_free(&frame);
    }
    return drawn;
}

/// The mean of a pixel, or of the four around its lower right corner.
static double exact_value(const double *exact, uint32_t side, uint32_t x, uint32_t y, bool corner) {
    const double *at = exact + (size_t)y * side + x;
    return corner ? 0.25 * (at[0] + at[1] + at[side] + at[side + 1]) : at[0];
}

/// The mean over pixels of the difference over all half vectors, relative to their sum.
static double mean_error(const distributions *drawn, const distributions *exact,
                         const direction_list *list, bool corner) {
    const uint32_t side = exact->side, end = side - 1;
    double sum = 0;
    for (uint32_t k = 0; k < end * end; k++) {
        double difference = 0, whole = 0;
        for (uint32_t i = 0; i < list->count; i++) {
            const double expected =
                exact_value(values_of(exact, i), side, k % end, k / end, corner);
            difference += fabs(values_of(drawn, i)[(size_t)(k / end) * side + k % end] - expected);
            whole += expected;
        }
        sum += difference / whole;
    }
    return sum / (end * end);
}

typedef struct map_error {
    double centre, corner;
} map_error;

static map_error measure(fixture *f, const measured_map *map, uint32_t box, const char *filter,
                         const char *const settings[6]) {
    const direction_list list = half_vectors();
    picture_request request = {
        .filter = filter, .settings = {"bias=0"}, .width = EXTENT / box, .height = EXTENT / box};
    for (int i = 0; i < 6 && settings[i]; i++)
        request.settings[1 + i] = settings[i];
    distributions exact = exact_distributions(map, &list, request.width);
    lobe_scene *scene = make_scene(map);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    double errors[2];
    for (int i = 0; i < 2; i++) {
        distributions drawn = draw_distributions(f, scene, &list, &request, i == 1);
        errors[i] = mean_error(&drawn, &exact, &list, i == 1);
        free(drawn.values);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    free(exact.values);
    return (map_error){errors[0], errors[1]};
}

// ---------------------------------------------------------------------------------------------
// Photographed maps

typedef struct candidate {
    const char *filter;
    const char *settings[6];
} candidate;

static const candidate candidates[] = {
    {"toksvig", {NULL}},
    {"lean", {NULL}},
    {"leadr", {NULL}},
    {"multi_leadr", {"components=1", NULL}},
    {"multi_leadr", {NULL}},
    {"multi_leadr", {"components=6", NULL}},
    {"lobes", {NULL}},
    {"fournier", {"peaks=4", NULL}},
    {"fournier", {NULL}},
    {"tan", {NULL}},
    {"tan", {"formulas=printed", NULL}},
    {"tan", {"start=kmeans", NULL}},
    {"moments", {"bins=1", NULL}},
    {"moments", {"bins=4", NULL}},
    {"mixture", {"shape=round", NULL}},
    {"mixture", {"shape=oval", NULL}},
    {"mixture", {"steps=1", NULL}},
    {"mixture", {"steps=8", NULL}},
    {"mixture", {NULL}},
    {"mixture", {"components=2", NULL}},
    {"mixture", {"components=6", NULL}},
};

/// The upper left part of a file, as numbers in [0, 1].
static lobe_image load_part(const fixture *f, const char *path) {
    lobe_image file, map = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    assert_int_equal(scenes_image_load(path, SCENE_IMAGE_DATA, &f->host, &file), LOBE_OK);
    assert_int_equal(file.format, LOBE_FORMAT_RGBA8_UNORM);
    for (uint32_t i = 0; i < 4 * EXTENT * EXTENT; i++) {
        const uint32_t x = i / 4 % EXTENT, y = i / 4 / EXTENT;
        const uint8_t *texel = (const uint8_t *)file.texels +
                               4 * ((size_t)(y % file.height) * file.width + x % file.width);
        ((float *)map.texels)[i] = (float)texel[i % 4] / 255;
    }
    lobe_image_free(&file);
    return map;
}

/// Of a von Mises-Fisher lobe about as broad as GGX of glTF's roughness.
static double concentration_of(double roughness) {
    const double alpha = fmax(roughness * roughness, 0.05);
    return 2 / (alpha * alpha);
}

/// `paths`: normals, or normals and a map of roughness with a comma between them.
static lobe_image load_map(const fixture *f, const char *paths) {
    char normals[1024];
    snprintf(normals, sizeof normals, "%.*s", (int)strcspn(paths, ","), paths);
    lobe_image map = load_part(f, normals);
    const char *comma = strchr(paths, ',');
    lobe_image roughness = load_part(f, comma ? comma + 1 : normals);
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++)
        ((float *)map.texels)[4 * i + 3] =
            comma ? (float)concentration_of((double)((const float *)roughness.texels)[4 * i + 1])
                  : (float)usual_concentration;
    lobe_image_free(&roughness);
    return map;
}

static void print_candidates(fixture *f, const char *name, const measured_map *map,
                             const candidate *list, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const candidate *c = &list[i];
        const map_error fine = measure(f, map, 8, c->filter, c->settings);
        const map_error coarse = measure(f, map, 32, c->filter, c->settings);
        printf("%-60s %-8s %-12s %5.1f %5.1f %5.1f %5.1f\n", name, c->filter,
               c->settings[0] ? c->settings[0] : "", 100 * fine.centre, 100 * fine.corner,
               100 * coarse.centre, 100 * coarse.corner);
    }
}

static void print_errors(fixture *f, const char *path) {
    measured_map map = {.lobes = load_map(f, path)};
    print_candidates(f, path, &map, candidates, sizeof candidates / sizeof *candidates);
    lobe_image_free(&map.lobes);
}

/// `named`: those of this name, or all "materials". Whether there are any.
static bool print_changing_materials(fixture *f, const char *named) {
    static const candidate compared[] = {
        {"lobes", {NULL}},
        {"moments", {"bins=4", NULL}},
        {"moments", {"bins=4", "colour=bins", NULL}},
        {"mixture", {NULL}},
        {"mixture", {"colour=mean", NULL}},
        {"mixture", {"steps=8", NULL}},
        {"mixture", {"components=6", NULL}},
    };
    bool any = false;
    for (int i = 0; i < CHANGING_MATERIALS; i++) {
        if (strcmp(named, "materials") != 0 && strcmp(named, changing_material_names[i]) != 0)
            continue;
        any = true;
        lobe_image colours;
        measured_map map = {changing_material(i, EXTENT, &colours), &colours};
        print_candidates(f, changing_material_names[i], &map, compared,
                         sizeof compared / sizeof *compared);
        lobe_image_free(&map.lobes);
        lobe_image_free(&colours);
    }
    return any;
}

// ---------------------------------------------------------------------------------------------
// Maps made here

/// Round stones of three sizes between flat joints: relief that changes over the map.
static lobe_image stones(void) {
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    float *texel = map.texels;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++, texel += 4) {
        const double x = i % EXTENT, y = (double)(i / EXTENT);
        const double pitch = x < EXTENT / 2 ? 9 : y < EXTENT / 2 ? 6.3 : 14;
        const double u = fmod(x, pitch) / pitch - 0.5, v = fmod(y, pitch) / pitch - 0.5;
        const double distance = hypot(u, v), slope = distance < 0.42 ? 1.6 : 0;
        const double normal[3] = {slope * u, -slope * v, 1};
        const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + 1);
        for (int k = 0; k < 4; k++)
            texel[k] = k < 3 ? (float)(0.5 + 0.5 * normal[k] / length) : (float)usual_concentration;
    }
    return map;
}

/// Components that start at their parents' are alike in neighbours: corners are about as accurate
/// as centres. Those that each texel finds alone are not, whatever the paper's prior, unless they
/// are evaluated one by one.
static void neighbours_blend(void **state) {
    measured_map map = {.lobes = stones()};
    const map_error mixture = measure(*state, &map, 8, "mixture", (const char *[6]){NULL});
    const map_error moments = measure(*state, &map, 8, "moments", (const char *[6]){"bins=4"});
    const map_error alone = measure(*state, &map, 8, "tan", (const char *[6]){"start=kmeans"});
    const map_error peaks = measure(*state, &map, 8, "fournier", (const char *[6]){"peaks=4"});
    lobe_image_free(&map.lobes);
    print_message("# mixture %.4f %.4f, moments %.4f %.4f, alone %.4f %.4f, one by one %.4f %.4f\n",
                  mixture.centre, mixture.corner, moments.centre, moments.corner, alone.centre,
                  alone.corner, peaks.centre, peaks.corner);
    assert_true(mixture.corner <= 1.15 * mixture.centre);
    assert_true(mixture.centre + mixture.corner <= 0.95 * (moments.centre + moments.corner));
    assert_true(alone.corner > 1.5 * alone.centre);
    assert_true(peaks.corner <= peaks.centre && peaks.corner <= 0.5 * alone.corner);
}

/// Leaves on soil, bricks in mortar: where texels differ, corners are only as accurate as centres
/// because their components are not blended.
static void corners_of_texels_that_differ_are_as_accurate(void **state) {
    static const int materials[] = {5, 7};
    for (int i = 0; i < 2; i++) {
        lobe_image colours;
        measured_map map = {changing_material(materials[i], EXTENT, &colours), &colours};
        const map_error single = measure(*state, &map, 8, "mixture", (const char *[6]){NULL});
        const map_error blended =
            measure(*state, &map, 8, "mixture", (const char *[6]){"blend_error=1"});
        print_message("# %s: single %.4f %.4f, blended %.4f %.4f\n",
                      changing_material_names[materials[i]], single.centre, single.corner,
                      blended.centre, blended.corner);
        assert_true(single.corner <= 1.3 * single.centre && single.centre <= blended.centre);
        assert_true(blended.corner > 1.7 * blended.centre);
        lobe_image_free(&map.lobes);
        lobe_image_free(&colours);
    }
}

/// Where relief, sharpness and colour change over the map, at equal bytes. Of the two bumps, each
/// in half of the map, that is so only because quarters of the map search for components of their
/// own.
static void materials_that_change_are_fitted_better(void **state) {
    static const int materials[] = {1, 7};
    double sums[2] = {0};
    for (int i = 0; i < 2; i++) {
        lobe_image colours;
        measured_map map = {changing_material(materials[i], EXTENT, &colours), &colours};
        const map_error mixture = measure(*state, &map, 8, "mixture", (const char *[6]){NULL});
        const map_error moments = measure(*state, &map, 8, "moments", (const char *[6]){"bins=4"});
        print_message("# %s: mixture %.4f %.4f, moments %.4f %.4f\n",
                      changing_material_names[materials[i]], mixture.centre, mixture.corner,
                      moments.centre, moments.corner);
        sums[0] += mixture.centre + mixture.corner;
        sums[1] += moments.centre + moments.corner;
        assert_true(mixture.centre + mixture.corner <= 0.65 * (moments.centre + moments.corner));
        lobe_image_free(&map.lobes);
        lobe_image_free(&colours);
    }
    assert_true(sums[0] <= 0.4 * sums[1]);
}

/// Paint and the metal in its cracks have one mean normal, but not one width: four components do
/// without parting these, six must not.
static void lobes_of_two_widths_at_one_place_are_parted(void **state) {
    static const int cracked_paint = 18;
    lobe_image colours;
    measured_map map = {changing_material(cracked_paint, EXTENT, &colours), &colours};
    const map_error four = measure(*state, &map, 8, "mixture", (const char *[6]){NULL});
    const map_error six = measure(*state, &map, 8, "mixture", (const char *[6]){"components=6"});
    print_message("# four %.4f %.4f, six %.4f %.4f\n", four.centre, four.corner, six.centre,
                  six.corner);
    assert_true(six.centre + six.corner <= 0.5 * (four.centre + four.corner));
    lobe_image_free(&map.lobes);
    lobe_image_free(&colours);
}

/// Slopes of stones and of the flat joints between them are no Gaussian.
static void several_lobes_of_slopes_halve_the_error_of_one(void **state) {
    measured_map map = {.lobes = stones()};
    const map_error one = measure(*state, &map, 8, "leadr", (const char *[6]){NULL});
    const map_error several = measure(*state, &map, 8, "multi_leadr", (const char *[6]){NULL});
    lobe_image_free(&map.lobes);
    print_message("# one %.4f %.4f, several %.4f %.4f\n", one.centre, one.corner, several.centre,
                  several.corner);
    assert_true(several.centre <= 0.5 * one.centre && several.corner <= 0.6 * one.corner);
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_blend),
        cmocka_unit_test(corners_of_texels_that_differ_are_as_accurate),
        cmocka_unit_test(materials_that_change_are_fitted_better),
        cmocka_unit_test(lobes_of_two_widths_at_one_place_are_parted),
        cmocka_unit_test(several_lobes_of_slopes_halve_the_error_of_one),
    };
    if (count < 2)
        return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
    void *state = NULL;
    fixture_create(&state);
    for (int i = 1; i < count; i++)
        if (!print_changing_materials(state, arguments[i]))
            print_errors(state, arguments[i]);
    fixture_destroy(&state);
    return 0;
}
