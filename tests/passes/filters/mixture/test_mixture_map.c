// Maps of mixtures: whatever the fit shares out, all components of a texel together have the
// moments of its lobes; one component has them all; separate clusters are found.

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/filters/mixture/mixture_map.h"
#include "passes/upload/material_maps.h"
#include "shaders/interface/gaussian_mixture.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/moment_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"

static const mixture_kind usual = {
    .components = 4, .steps = 4, .shape = MIXTURE_SHAPE_ROUND, .format = LOBE_FORMAT_RGBA32_FLOAT};

/// A map that was read back, and the units of its numbers.
typedef struct built_map {
    moment_map map;
    float *texels;          ///< layers within levels
    moment_partition units; ///< with one bin for all components
} built_map;

/// Ends the scene with a square of the material.
static built_map build_map(fixture *f, lobe_scene *scene, const lobe_material *material,
                           const mixture_kind *kind, pass_run *run) {
    scene_end_with_square(scene, material);
    pass_run_begin(run, f, scene, "mixture", (const char *[]){NULL});
    built_map built = {.map = passes_mixture_map(&run->context, 0, kind)};
    lobe_graph_read_back(f->graph, built.map.bins, (lobe_range){0});
    built.texels = pass_run_read(run, &built.map.map, built.map.format);
    size_t size;
    const void *constants = lobe_graph_data(f->graph, built.map.bins, &size);
    assert_int_equal(size, sizeof built.units.constants);
    memcpy(&built.units.constants, constants, size);
    const device_material *uploaded = &run->scene->materials[0];
    const lobe_grid grid = passes_lobe_grid(uploaded);
    built.units.bins = 1;
    built.units.own_colours = kind->own_colours;
    built.units.width = grid.width;
    built.units.height = grid.height;
    return built;
}

/// The sums of all components, as a map of one bin. To free by the caller.
static float *sum_components(const built_map *built, const mixture_kind *kind, reduced_map *sums) {
    const reduced_map *map = &built->map.map;
    const uint32_t each = kind->own_colours ? 3 : 2;
    *sums = *map;
    sums->layers = kind->own_colours ? each + 1 : each;
    float *result = calloc(passes_reduced_map_bytes(sums, LOBE_FORMAT_RGBA32_FLOAT), 1);
    assert_non_null(result);
    const float *from = built->texels;
    float *to = result;
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        const size_t count = (size_t)4 * width * height;
        for (uint32_t layer = 0; layer < map->layers; layer++, from += count) {
            const uint32_t target = layer == each * kind->components ? each : layer % each;
            for (size_t i = 0; i < count; i++)
                to[target * count + i] += from[i];
        }
        to += sums->layers * count;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
    return result;
}

/// Compares with means in double precision, and destroys the scene.
static void check_sums(fixture *f, lobe_scene *scene, const lobe_material *material,
                       const mixture_kind *kind, double tolerance, double rounding) {
    pass_run run;
    fixture_need_exact_sampler(f);
    built_map built = build_map(f, scene, material, kind, &run);
    reduced_map sums;
    float *texels = sum_components(&built, kind, &sums);
    reference_moment_bins bins =
        moment_bins_of(&built.units, (double)built.units.constants.largest[1] *
                                         (double)run.scene->materials[0].values.largest_colour);
    bins.mirrored = false;
    reference_layers exact = moments_of_texels(scene, material, &bins, false);
    check_reduced_levels(&sums, texels, &exact, tolerance, rounding);
    reference_layers_free(&exact);
    free(texels);
    free(built.texels);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// Three tilted lobes of different widths and colours.
static lobe_material leaning_lobes(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 30);
    material.lobe_count = 3;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 3, {0.1f, 0.2f, 0.3f}};
    material.lobes[2] = (lobe_base_lobe){{-0.48f, 0.64f, 0.6f}, 15, {0.1f, 0.1f, 0.1f}};
    return material;
}

/// Sizes whose levels are halves, so that a level's means are those of the level before; the last
/// one has levels that a group fits.
static const uint32_t sizes[][2] = {{1, 8}, {2, 2}, {16, 8}, {256, 128}};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void components_add_up_to_all_lobes(void **state) {
    for (int i = 0; i < SIZES; i++) {
        mixture_kind kind = usual;
        kind.components = 2 + (uint32_t)i;
        kind.steps = i == SIZES - 1 ? 16 : 4;
        kind.shape = (uint32_t)i % 3;
        lobe_material material = leaning_lobes();
        lobe_scene *scene = scene_begin();
        material.normal_map =
            scene_add_map(scene, random_normal_map(sizes[i][0], sizes[i][1], 0.8, 11));
        check_sums(*state, scene, &material, &kind, 3e-5, 0);
    }
}

static void widths_and_colours_add_up(void **state) {
    for (int i = 0; i < SIZES - 1; i++) {
        mixture_kind kind = usual;
        kind.own_colours = true;
        lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 0.7);
        material.base_colour[1] = 0.5f;
        lobe_scene *scene = scene_begin();
        material.normal_map =
            scene_add_map(scene, random_normal_map(sizes[i][0], sizes[i][1], 0.8, 21));
        material.metallic_roughness_map =
            scene_add_map(scene, random_map(sizes[i][0], sizes[i][1], 0.3, 1, 22));
        check_sums(*state, scene, &material, &kind, 3e-5, 0);
    }
}

static void sixteen_bits_are_within_a_step(void **state) {
    mixture_kind kind = usual;
    kind.format = LOBE_FORMAT_RGBA16_SNORM;
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, random_normal_map(32, 16, 0.8, 31));
    check_sums(*state, scene, &material, &kind, 3e-5, 0.51 * kind.components / 32767);
}

static void one_component_is_one_gaussian(void **state) {
    mixture_kind kind = usual;
    kind.components = 1;
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, random_normal_map(32, 16, 0.8, 41));
    check_sums(*state, scene, &material, &kind, 3e-5, 0);
}

/// Eight bits of a nearly flat map: (128, 128, 255), and one step from there in some texels.
static lobe_image flat_bytes(uint32_t extent) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA8_UNORM, extent, extent);
    uint8_t *texel = image.texels;
    for (uint32_t i = 0; i < extent * extent; i++, texel += 4) {
        texel[0] = (uint8_t)(i % 7 == 0 ? 129 : 128);
        texel[1] = (uint8_t)(i % 11 == 0 ? 127 : 128);
        texel[2] = 255;
    }
    return image;
}

/// What is stored of a component; variances about its mean are not below zero.
static void check_component(const float *place, const float *spread, size_t layer) {
    for (int i = 0; i < 4; i++)
        assert_true(isfinite(place[i]) && isfinite(spread[i]));
    const double mass = (double)place[0];
    assert_true(mass >= 0 && mass <= 1);
    if (mass < 1e-6)
        return;
    for (int i = 0; i < 2; i++) {
        const double mean = (double)place[1 + i] / mass;
        if (!((double)spread[i] / mass - mean * mean >= -1e-5))
            fail_msg("component %zu: a variance of %g", layer,
                     (double)spread[i] / mass - mean * mean);
    }
    assert_true(spread[3] >= 0);
}

/// The sharpest base lobes over normals that hardly differ.
static void flat_bytes_have_variances(void **state) {
    enum { FLAT = 32 };
    const mixture_kind kind = usual;
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1e4f);
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, flat_bytes(FLAT));
    pass_run run;
    built_map built = build_map(*state, scene, &material, &kind, &run);
    const reduced_map *map = &built.map.map;
    const float *texels = built.texels;
    uint32_t width = map->width;
    for (uint32_t level = 0; level < map->levels; level++, width /= 2) {
        const size_t count = (size_t)width * width;
        for (size_t j = 0; j < kind.components; j++)
            for (size_t i = 0; i < count; i++)
                check_component(texels + 4 * (2 * j * count + i),
                                texels + 4 * ((2 * j + 1) * count + i), j);
        texels += 4 * map->layers * count;
    }
    free(built.texels);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// Moments of a component of the coarsest level, in the plane's own units.
typedef struct component_moments {
    double part, mean[2], covariance[3];
} component_moments;

static component_moments coarsest_component(const built_map *built, uint32_t index) {
    const reduced_map *map = &built->map.map;
    const uint64_t bytes = passes_reduced_map_bytes(map, built->map.format);
    const float *last = built->texels + bytes / sizeof(float) - (size_t)4 * map->layers;
    const float *place = last + (size_t)8 * index, *spread = place + 4;
    const float *range = built->units.constants.bins[0].range;
    const double mass = (double)place[0], unit = (double)range[2];
    component_moments m = {.part = mass * (double)built->units.constants.largest[0]};
    const double mean[2] = {(double)place[1] / mass, (double)place[2] / mass};
    for (int i = 0; i < 2; i++)
        m.mean[i] = mean[i] * unit + (double)range[i];
    for (int i = 0; i < 3; i++) {
        const int a = i == 1, b = i != 0;
        m.covariance[i] = unit * unit * ((double)spread[i] / mass - mean[a] * mean[b]);
    }
    return m;
}

enum { CLUSTERS = 4, EXTENT = 64 };

/// The place in the Lambert plane of a texel of one of four clusters, and the normal there.
static void cluster_place(uint32_t texel, uint32_t *cluster, double place[2]) {
    static const double centres[CLUSTERS][2] = {{0.4, 0.1}, {-0.3, 0.3}, {0.1, -0.4}, {0, 0}};
    *cluster = texel % CLUSTERS;
    const double angle = 2.4 * texel;
    const double radius = 0.02 + 0.005 * *cluster;
    place[0] = centres[*cluster][0] + radius * cos(angle);
    place[1] = centres[*cluster][1] + radius * sin(angle);
}

static lobe_image clustered_map(void) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    float *texel = image.texels;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++, texel += 4) {
        uint32_t cluster;
        double place[2];
        cluster_place(i, &cluster, place);
        const double square = place[0] * place[0] + place[1] * place[1];
        for (int axis = 0; axis < 2; axis++)
            texel[axis] = (float)(0.5 + 0.5 * place[axis] * sqrt(1 - square / 4));
        texel[2] = (float)(1 - square / 4);
        texel[3] = 1;
    }
    return image;
}

/// Each cluster becomes a component with the cluster's own mean and variances; the M-step that the
/// paper prints would make these four times too small.
static void clusters_are_found(void **state) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, clustered_map());
    material.normal_map.nearest = true;
    mixture_kind kind = usual;
    kind.steps = 8;
    pass_run run;
    built_map built = build_map(*state, scene, &material, &kind, &run);
    bool found[CLUSTERS] = {false};
    for (uint32_t i = 0; i < CLUSTERS; i++) {
        const component_moments m = coarsest_component(&built, i);
        for (uint32_t k = 0; k < CLUSTERS; k++) {
            uint32_t cluster;
            double place[2], mean[2] = {0}, variance = 0;
            for (uint32_t texel = k; texel < EXTENT * EXTENT; texel += CLUSTERS) {
                cluster_place(texel, &cluster, place);
                for (int axis = 0; axis < 2; axis++)
                    mean[axis] += place[axis] * CLUSTERS / (EXTENT * EXTENT);
            }
            if (hypot(m.mean[0] - mean[0], m.mean[1] - mean[1]) > 0.01)
                continue;
            variance = 0.5 * (0.02 + 0.005 * k) * (0.02 + 0.005 * k);
            found[k] = true;
            assert_float_equal(m.part, 0.25, 1e-3);
            assert_float_equal(m.covariance[0] / variance, 1, 0.02);
            assert_float_equal(m.covariance[1] / variance, 1, 0.02);
            assert_true(fabs(m.covariance[2]) < 0.02 * variance);
        }
    }
    for (uint32_t k = 0; k < CLUSTERS; k++)
        assert_true(found[k]);
    free(built.texels);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(components_add_up_to_all_lobes),
        cmocka_unit_test(widths_and_colours_add_up),
        cmocka_unit_test(sixteen_bits_are_within_a_step),
        cmocka_unit_test(one_component_is_one_gaussian),
        cmocka_unit_test(flat_bytes_have_variances),
        cmocka_unit_test(clusters_are_found),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
