// The map of lobe moments against means in double precision: every level, layer and channel.

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/filters/moments/binning.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/moment_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/map/box_reduction.h"

/// How a map is made, and how accurate it must be.
typedef struct map_request {
    uint32_t kind, bins; ///< of the partition, as requested
    bool colour;
    double colour_scale; ///< without what the material's own colours add
    const char *base;    ///< assignment
    lobe_format format;
    double rounding; ///< absolute, of each level
    double tolerance;
} map_request;

static const map_request usual = {
    .colour_scale = 1, .base = "base=exact", .format = LOBE_FORMAT_RGBA32_FLOAT, .tolerance = 2e-5};

/// A map that was read back: layers within levels.
typedef void (*map_check)(const float *texels, const moment_map *map, const reference_layers *exact,
                          const reference_moment_bins *bins, const map_request *request);

/// Destroys the scene afterwards.
static void with_map(fixture *f, lobe_scene *scene, const lobe_material *material,
                     const map_request *request, map_check check) {
    fixture_need_exact_sampler(f);
    scene_end_with_square(scene, material);
    pass_run run;
    pass_run_begin(&run, f, scene, "moments", (const char *[]){request->base, NULL});
    moment_partition partition;
    const partition_request wanted = {
        request->kind,
        {.bins = request->bins, .colour = request->colour ? BIN_COLOUR_OWN : BIN_COLOUR_MEAN}};
    assert_int_equal(passes_moment_partition_make(run.scene, 0, &wanted, &f->host, &partition),
                     LOBE_OK);
    partition.constants.largest[1] = (float)request->colour_scale;
    reference_moment_bins bins = moment_bins_of(
        &partition, request->colour_scale * (double)run.scene->materials[0].values.largest_colour);
    const lobe_resource constants =
        lobe_graph_upload(f->graph, "bins", &partition.constants, sizeof partition.constants);
    const moment_map map =
        passes_moment_binning(&run.context, 0, &partition, constants, request->format);
    reference_layers exact =
        moments_of_texels(scene, material, &bins, strcmp(request->base, "base=lobe") == 0);
    float *texels = pass_run_read(&run, &map.map, map.format);
    check(texels, &map, &exact, &bins, request);
    free(texels);
    reference_layers_free(&exact);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

/// Every level and layer.
static void check_all(const float *texel, const moment_map *map, const reference_layers *texels,
                      const reference_moment_bins *bins, const map_request *request) {
    assert_int_equal(map->map.layers, reference_moment_layers(bins));
    check_reduced_levels(&map->map, texel, texels, request->tolerance, request->rounding);
}

static lobe_material purple_metal(lobe_distribution distribution) {
    lobe_material material = microfacet_material(distribution, 1, 0.7);
    material.base_colour[1] = 0.5f;
    return material;
}

/// Three tilted lobes of different widths and colours.
static lobe_material leaning_lobes(lobe_distribution distribution) {
    lobe_material material = half_vector_material(distribution, 30);
    material.lobe_count = 3;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 3, {0.1f, 0.2f, 0.3f}};
    material.lobes[2] = (lobe_base_lobe){{-0.48f, 0.64f, 0.6f}, 15, {0.1f, 0.1f, 0.1f}};
    material.base_colour[2] = 0.75f;
    return material;
}

/// Normals and widths of different sizes; `colours`: colour maps too.
static lobe_scene *mapped_scene(lobe_material *material, uint32_t width, uint32_t height,
                                bool colours, uint64_t seed) {
    bool microfacet = material->model == LOBE_MATERIAL_MICROFACET;
    lobe_scene *scene = scene_begin();
    material->normal_map = scene_add_map(scene, random_normal_map(width, height, 0.8, seed));
    lobe_texture_use widths =
        scene_add_map(scene, random_map(height, width, 0.3, microfacet ? 1 : 3, seed + 1));
    if (microfacet)
        material->metallic_roughness_map = widths;
    else
        material->width_map = widths;
    if (colours)
        material->base_colour_map = scene_add_map(scene, random_map(3, 2, 0.1, 1, seed + 2));
    if (colours && !microfacet)
        material->specular_map = scene_add_map(scene, random_map(width, 1, 0.1, 2, seed + 3));
    return scene;
}

static const uint32_t sizes[][2] = {{1, 7}, {7, 1}, {2, 2}, {16, 8}, {23, 13}};
enum { SIZES = sizeof sizes / sizeof *sizes, KINDS = 3 };

static void microfacets_of_any_size(void **state) {
    for (int i = 0; i < SIZES * KINDS; i++) {
        lobe_material material = purple_metal((lobe_distribution)(i % 4));
        lobe_scene *scene = mapped_scene(&material, sizes[i / KINDS][0], sizes[i / KINDS][1], i % 2,
                                         301 + (uint64_t)i);
        map_request request = usual;
        request.kind = (uint32_t)(i % KINDS);
        request.bins = 4;
        request.colour = i % 2;
        request.base = i % 5 ? "base=exact" : "base=lobe";
        with_map(*state, scene, &material, &request, check_all);
    }
}

static void lobes_of_any_size(void **state) {
    for (int i = 0; i < SIZES * KINDS; i++) {
        lobe_material material =
            leaning_lobes(i % 4 < 2 ? LOBE_DISTRIBUTION_VMF : LOBE_DISTRIBUTION_BLINN_PHONG);
        material.normal_concentration = i % 3 ? 0 : 50;
        lobe_scene *scene = mapped_scene(&material, sizes[i / KINDS][0], sizes[i / KINDS][1], i % 2,
                                         321 + (uint64_t)i);
        map_request request = usual;
        request.kind = (uint32_t)(i % KINDS);
        request.bins = 1 + (uint32_t)i % MOMENT_MAXIMUM_BINS;
        request.colour = i % 2;
        request.colour_scale = 8;
        request.base = i % 5 ? "base=exact" : "base=lobe";
        with_map(*state, scene, &material, &request, check_all);
    }
}

/// Without a normal map every texel is upright, and only widths distinguish bins.
static void widths_alone(void **state) {
    for (uint32_t kind = 0; kind < KINDS; kind++) {
        lobe_material material = purple_metal(LOBE_DISTRIBUTION_GGX);
        lobe_scene *scene = scene_begin();
        material.metallic_roughness_map = scene_add_map(scene, random_map(9, 12, 0.1, 1, 341));
        map_request request = usual;
        request.kind = kind;
        request.bins = 2;
        with_map(*state, scene, &material, &request, check_all);
    }
}

/// 16 bits keep numbers in [-1, 1] to half a step per level, or to float16's eleven binary digits.
static void sixteen_bits_are_within_a_step(void **state) {
    static const struct {
        lobe_format format;
        double rounding, tolerance;
    } formats[] = {{LOBE_FORMAT_RGBA16_SNORM, 0.51 / 32767, 2e-5},
                   {LOBE_FORMAT_RGBA16_FLOAT, 1e-7, 3e-3}};
    for (int i = 0; i < 2 * KINDS; i++) {
        lobe_material material =
            i % 2 ? purple_metal((lobe_distribution)(i / 2)) : leaning_lobes(LOBE_DISTRIBUTION_VMF);
        lobe_scene *scene = mapped_scene(&material, 23, 14, true, 351 + (uint64_t)i);
        map_request request = usual;
        request.kind = (uint32_t)(i / 2);
        request.bins = 3;
        request.colour = true;
        request.colour_scale = 8;
        request.format = formats[i % 2].format;
        request.rounding = formats[i % 2].rounding;
        request.tolerance = formats[i % 2].tolerance;
        with_map(*state, scene, &material, &request, check_all);
    }
}

/// Adds what two texels have of a bin, in the plane's own units.
static void add_moments(const moment_bin *bin, const float place[4], const float spread[4],
                        double sum[8]) {
    const double unit = (double)bin->range[2], mass = (double)place[0];
    sum[0] += mass;
    sum[3] += (double)place[3] * (double)bin->range[3];
    sum[7] += (double)spread[3] * (double)bin->shape[3];
    for (int i = 0; i < 2; i++)
        sum[1 + i] += (double)place[1 + i] * unit + mass * (double)bin->range[i];
    for (int i = 0; i < 3; i++) {
        int a = i == 1, b = i != 0;
        double first = (double)bin->range[a], second = (double)bin->range[b];
        sum[4 + i] += unit * unit * (double)spread[i] + mass * first * second +
                      unit * ((double)place[1 + a] * second + (double)place[1 + b] * first);
    }
}

/// The bins add up to a single bin for all lobes, in every texel of every level.
static void check_sums(const float *texels, const moment_map *map, const reference_layers *exact,
                       const reference_moment_bins *bins, const map_request *request) {
    (void)exact;
    const float *level = texels;
    uint32_t width = map->map.width, height = map->map.height;
    static double sums[2][8 * 4096];
    static int calls;
    double *sum = sums[calls++ % 2];
    for (uint32_t i = 0; i < map->map.levels; i++) {
        uint32_t count = width * height;
        for (uint32_t j = 0; j < count; j++, sum += 8) {
            memset(sum, 0, 8 * sizeof *sum);
            for (uint32_t bin = 0; bin < bins->bins; bin++)
                add_moments(&bins->constants.bins[bin], level + 4 * (2 * bin * count + j),
                            level + 4 * ((2 * bin + 1) * count + j), sum);
        }
        level += (size_t)4 * count * map->map.layers;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
    }
    size_t used = (size_t)(sum - sums[(calls - 1) % 2]);
    assert_true(used > 0 && used <= sizeof sums[0] / sizeof **sums);
    for (size_t i = 0; calls > 1 && i < used; i++)
        if (!(fabs(sums[0][i] - sums[1][i]) <= request->tolerance))
            fail_msg("partition %u of %u: %.8g of all bins, then %.8g", request->kind,
                     request->bins, sums[0][i], sums[1][i]);
}

static void bins_add_up_to_all_lobes(void **state) {
    static const uint32_t partitions[][2] = {{0, 1}, {0, 2}, {0, 6}, {1, 0}, {2, 0}};
    for (size_t i = 0; i < sizeof partitions / sizeof *partitions; i++) {
        lobe_material material = leaning_lobes(LOBE_DISTRIBUTION_VMF);
        lobe_scene *scene = mapped_scene(&material, 31, 18, false, 361);
        map_request request = usual;
        request.kind = partitions[i][0];
        request.bins = partitions[i][1];
        with_map(*state, scene, &material, &request, check_sums);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(microfacets_of_any_size),
        cmocka_unit_test(lobes_of_any_size),
        cmocka_unit_test(widths_alone),
        cmocka_unit_test(sixteen_bits_are_within_a_step),
        cmocka_unit_test(bins_add_up_to_all_lobes),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
