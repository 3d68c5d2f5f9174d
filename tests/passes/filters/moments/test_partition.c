// How a material's lobes are distributed over bins: which lobes are separated, how many bins that
// takes, and that nothing exceeds the ranges.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/filters/moments/partition.h"
#include "passes/upload/scene_upload.h"
#include "tests/passes/support/moment_reference.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

/// A number of bins to be chosen.
enum { AUTOMATIC = 0 };

/// What fetches must gain by default.
static const double usual_gain = 0.115;

/// Uploads a scene of one square and returns its material's partition. Destroys the scene
/// afterwards, unless `keep`.
static moment_partition partition_at_gain(fixture *f, lobe_scene *scene,
                                          const lobe_material *material, uint32_t kind,
                                          uint32_t bins, double gain, bool keep) {
    scene_end_with_square(scene, material);
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    const partition_request request = {kind, {bins, BIN_COLOUR_AUTOMATIC, gain}};
    moment_partition partition, again;
    assert_int_equal(passes_moment_partition_make(uploaded, 0, &request, &f->host, &partition),
                     LOBE_OK);
    assert_int_equal(passes_moment_partition_make(uploaded, 0, &request, &f->host, &again),
                     LOBE_OK);
    assert_memory_equal(&partition, &again, sizeof partition);
    passes_device_scene_destroy(&uploaded);
    if (!keep)
        lobe_scene_destroy(&scene);
    return partition;
}

static moment_partition partition_of(fixture *f, lobe_scene *scene, const lobe_material *material,
                                     uint32_t kind, uint32_t bins, bool keep) {
    return partition_at_gain(f, scene, material, kind, bins, usual_gain, keep);
}

/// A map whose texels take turns at `count` normals, each tilted from the pole towards +X by an
/// angle in degrees.
static lobe_image tilts_in_turn(uint32_t width, uint32_t height, const double *tilts,
                                uint32_t count) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        double tilt = tilts[(i % width + i / width) % count] * M_PI / 180;
        float *texel = (float *)image.texels + (size_t)4 * i;
        texel[0] = (float)(0.5 + 0.5 * sin(tilt));
        texel[1] = 0.5f;
        texel[2] = (float)(0.5 + 0.5 * cos(tilt));
    }
    return image;
}

/// The same with factors of width.
static lobe_image widths_in_turn(uint32_t width, uint32_t height, const float *widths,
                                 uint32_t count) {
    lobe_image image = constant_map(width, height, 1, 1, 1);
    for (uint32_t i = 0; i < width * height; i++)
        ((float *)image.texels)[(size_t)4 * i] = widths[(i % width + i / width) % count];
    return image;
}

static moment_partition partition_of_tilts(fixture *f, float concentration, const double *tilts,
                                           uint32_t count, uint32_t bins) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, concentration);
    material.normal_map = scene_add_map(scene, tilts_in_turn(64, 48, tilts, count));
    material.normal_map.nearest = true;
    return partition_of(f, scene, &material, PARTITION_FITTED, bins, false);
}

static moment_partition partition_of_widths(fixture *f, const float *widths, uint32_t count,
                                            uint32_t bins) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    material.width_map = scene_add_map(scene, widths_in_turn(24, 24, widths, count));
    material.width_map.nearest = true;
    return partition_of(f, scene, &material, PARTITION_FITTED, bins, false);
}

/// The bin that has nearly all of a lobe.
static uint32_t bin_of(const moment_partition *partition, double tilt, double concentration) {
    reference_moment_bins bins = moment_bins_of(partition, 1);
    double members[MOMENT_MAXIMUM_BINS];
    reference_plane_lobe lobe = {.place = {2 * sin(tilt * M_PI / 360), 0},
                                 .variance = 1 / concentration};
    reference_bin_members(&bins, &lobe, members);
    for (uint32_t i = 0; i < partition->bins; i++)
        if (members[i] > 0.99)
            return i;
    fail_msg("a lobe of kappa %g at %g degrees: bins have (%g, %g, %g) of it", concentration, tilt,
             members[0], members[1], members[2]);
    return 0;
}

static const double two_sides[] = {-30, 30};
static const float two_widths[] = {20, 2000};

static void directions_are_told_apart(void **state) {
    moment_partition partition = partition_of_tilts(*state, 300, two_sides, 2, 2);
    assert_int_equal(partition.bins, 2);
    assert_int_not_equal(bin_of(&partition, -30, 300), bin_of(&partition, 30, 300));
}

static void widths_are_told_apart(void **state) {
    moment_partition partition = partition_of_widths(*state, two_widths, 2, 2);
    assert_int_equal(partition.bins, 2);
    assert_int_not_equal(bin_of(&partition, 0, 20), bin_of(&partition, 0, 2000));
}

static void as_many_bins_as_pay(void **state) {
    static const double flat[] = {20}, three[] = {-40, 0, 40};
    static const float one_width[] = {50}, four_widths[] = {2, 40, 800, 16000};
    assert_int_equal(partition_of_tilts(*state, 300, flat, 1, AUTOMATIC).bins, 1);
    assert_int_equal(partition_of_widths(*state, one_width, 1, AUTOMATIC).bins, 1);
    assert_int_equal(partition_of_tilts(*state, 300, two_sides, 2, AUTOMATIC).bins, 2);
    // Two widths, equally frequent, are those of a bin's two Gaussians.
    assert_int_equal(partition_of_widths(*state, two_widths, 2, AUTOMATIC).bins, 1);
    assert_true(partition_of_widths(*state, four_widths, 4, AUTOMATIC).bins > 1);
    assert_int_equal(partition_of_tilts(*state, 300, three, 3, AUTOMATIC).bins, 3);
    // Lobes so broad that the normals have no visible effect.
    assert_int_equal(partition_of_tilts(*state, 1, two_sides, 2, AUTOMATIC).bins, 1);
}

/// Pyramids of 16 x 16 texels, whose sides have a slope of one half.
static lobe_image pyramids(uint32_t extent) {
    lobe_image image = constant_map(extent, extent, 0.5f, 0.5f, 1);
    for (uint32_t i = 0; i < extent * extent; i++) {
        const double x = (double)(i % extent % 16) - 7.5, y = (double)(i / extent % 16) - 7.5,
                     cosine = sqrt(0.8);
        float *texel = (float *)image.texels + (size_t)4 * i;
        texel[fabs(x) > fabs(y) ? 0 : 1] =
            (float)(0.5 + copysign(0.25 * cosine, fabs(x) > fabs(y) ? x : y));
        texel[2] = (float)(0.5 + 0.5 * cosine);
    }
    return image;
}

/// Under a point of light many sharp lobes are spikes, which no bins match; a broad one shows where
/// there are more of them.
static void sharp_lobes_of_many_directions_take_several_bins(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.1, 1);
    material.normal_map = scene_add_map(scene, pyramids(64));
    assert_true(partition_of(*state, scene, &material, PARTITION_FITTED, AUTOMATIC, false).bins >
                3);
}

/// Of pyramids of a dielectric of this diffuse colour.
static uint32_t bins_of_pyramids_over(fixture *f, float diffuse) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.4, 0);
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = diffuse;
    material.normal_map = scene_add_map(scene, pyramids(64));
    return partition_of(f, scene, &material, PARTITION_FITTED, AUTOMATIC, false).bins;
}

/// Four hundredths of the light hardly show beside Lambert's part.
static void lobes_that_are_hardly_seen_take_fewer_bins(void **state) {
    const uint32_t bright = bins_of_pyramids_over(*state, 0.9f);
    assert_true(bright < 4);
    assert_true(bins_of_pyramids_over(*state, 0.005f) > bright + 1);
}

/// Polish outshines the few rough texels where both are seen, but is seen from fewer directions.
static void few_rough_texels_among_polish_have_a_bin(void **state) {
    enum { EXTENT = 64 };
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    lobe_image widths = random_map(EXTENT, EXTENT, 0, 1, 51);
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        float *width = (float *)widths.texels + (size_t)4 * i;
        width[1] = width[1] < 0.05f ? 0.5f : 0.06f;
        width[2] = 1;
    }
    material.metallic_roughness_map = scene_add_map(scene, widths);
    material.normal_map = scene_add_map(scene, random_normal_map(EXTENT, EXTENT, 0.04, 52));
    assert_int_equal(
        partition_of(*state, scene, &material, PARTITION_FITTED, AUTOMATIC, false).bins, 2);
}

/// Of noise on rough metal, where each further bin gains a little.
static uint32_t bins_of_noise_at_gain(fixture *f, double gain) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.3, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.7, 33));
    return partition_at_gain(f, scene, &material, PARTITION_FITTED, AUTOMATIC, gain, false).bins;
}

static void the_less_fetches_must_gain_the_more_bins(void **state) {
    static const double gains[] = {0.9, 0.3, 0.1, 0.02, 0};
    uint32_t before = 1;
    assert_int_equal(bins_of_noise_at_gain(*state, gains[0]), 1);
    for (size_t i = 1; i < sizeof gains / sizeof *gains; i++) {
        const uint32_t bins = bins_of_noise_at_gain(*state, gains[i]);
        assert_true(bins >= before);
        before = bins;
    }
    assert_true(before > 3);
}

/// Squares of a few texels show parts of two lobes that all the maps have in equal parts, which one
/// bin stands for.
static void small_footprints_take_bins_too(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    lobe_image widths = constant_map(64, 64, 1, 1, 1);
    for (uint32_t i = 0; i < 64 * 64; i++)
        ((float *)widths.texels)[(size_t)4 * i] = two_widths[(i % 64 / 8 + i / 64 / 8) % 2];
    material.width_map = scene_add_map(scene, widths);
    assert_int_equal(
        partition_of(*state, scene, &material, PARTITION_FITTED, AUTOMATIC, false).bins, 2);
}

/// Noise beside polished facets of two sides, which reflect this part of what the noise does.
static moment_partition partition_of_noise_and_facets(fixture *f, float facets) {
    enum { EXTENT = 128 };
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 31);
    lobe_image widths = random_map(EXTENT, EXTENT, 0.1, 1, 32);
    lobe_image colours = constant_map(EXTENT, EXTENT, 1, 1, 1);
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const size_t at = (size_t)4 * i;
        ((float *)widths.texels)[at + 2] = 1;
        if (i % EXTENT < EXTENT / 2)
            continue;
        const double tilt = (i / 2 % 2 ? 17 : -17) * M_PI / 180;
        ((float *)normals.texels)[at] = (float)(0.5 + 0.5 * sin(tilt));
        ((float *)normals.texels)[at + 1] = 0.5f;
        ((float *)normals.texels)[at + 2] = (float)(0.5 + 0.5 * cos(tilt));
        ((float *)widths.texels)[at + 1] = 0.2f;
        for (size_t k = 0; k < 3; k++)
            ((float *)colours.texels)[at + k] = facets;
    }
    material.normal_map = scene_add_map(scene, normals);
    material.metallic_roughness_map = scene_add_map(scene, widths);
    material.base_colour_map = scene_add_map(scene, colours);
    return partition_of(f, scene, &material, PARTITION_FITTED, 3, false);
}

static bool tells_apart(const moment_partition *partition, double tilt, double concentration) {
    double members[2][MOMENT_MAXIMUM_BINS], shared = 0;
    reference_moment_bins bins = moment_bins_of(partition, 1);
    for (int i = 0; i < 2; i++) {
        reference_plane_lobe lobe = {.place = {2 * sin((i ? tilt : -tilt) * M_PI / 360), 0},
                                     .variance = 1 / concentration};
        reference_bin_members(&bins, &lobe, members[i]);
    }
    for (uint32_t k = 0; k < partition->bins; k++)
        shared += fmin(members[0][k], members[1][k]);
    return shared < 0.01;
}

static void black_texels_decide_nothing(void **state) {
    const moment_partition bright = partition_of_noise_and_facets(*state, 1),
                           black = partition_of_noise_and_facets(*state, 1e-3f);
    assert_true(tells_apart(&bright, 17, 1250));
    assert_false(tells_apart(&black, 17, 1250));
}

/// Whether bins get colours of their own, for metal whose lobes alternate from texel to texel, and
/// its colours every `pitch` texels.
static bool colours_are_own(fixture *f, double tilt, const float widths[2], uint32_t pitch) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    material.metallic = 1;
    material.metallic_roughness_map = scene_add_map(scene, constant_map(64, 64, 1, 1, 1));
    material.normal_map =
        scene_add_map(scene, tilts_in_turn(64, 64, (const double[]){-tilt, tilt}, 2));
    material.base_colour_map = scene_add_map(scene, constant_map(64, 64, 0.9f, 0.2f, 0.1f));
    for (uint32_t i = 0; i < 64 * 64; i++) {
        const uint32_t column = i % 64, row = i / 64;
        float *width = (float *)scene->images[0].image.texels + (size_t)4 * i;
        float *colour = (float *)scene->images[2].image.texels + (size_t)4 * i;
        width[1] = widths[(column + row) % 2];
        if ((column / pitch + row) % 2)
            colour[0] = 0.1f, colour[2] = 0.9f;
    }
    return partition_of(f, scene, &material, PARTITION_FITTED, AUTOMATIC, false).own_colours;
}

static void bins_have_colours_that_go_with_lobes(void **state) {
    static const float one_width[2] = {0.4f, 0.4f}, differing[2] = {0.2f, 0.6f};
    assert_true(colours_are_own(*state, 25, one_width, 1));
    assert_true(colours_are_own(*state, 0, differing, 1));
    // Colours that change every second texel, lobes that change with each.
    assert_false(colours_are_own(*state, 25, one_width, 2));
    assert_false(colours_are_own(*state, 0, differing, 2));
    assert_false(colours_are_own(*state, 0, one_width, 1));
}

static void what_was_asked_for(void **state) {
    for (uint32_t bins = 1; bins <= MOMENT_MAXIMUM_BINS; bins++)
        assert_int_equal(partition_of_tilts(*state, 300, two_sides, 2, bins).bins, bins);
    for (uint32_t kind = PARTITION_HATS; kind <= PARTITION_CAP; kind++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
        material.width_map = scene_add_map(scene, widths_in_turn(8, 8, two_widths, 2));
        material.width_map.nearest = true;
        moment_partition partition = partition_of(*state, scene, &material, kind, 3, false);
        assert_int_equal(partition.bins, kind == PARTITION_CAP ? 6 : 5);
        // Between the two widths.
        assert_int_equal(bin_of(&partition, 0, 20), 0);
        reference_moment_bins bins = moment_bins_of(&partition, 1);
        double members[MOMENT_MAXIMUM_BINS];
        reference_plane_lobe sharp = {.variance = 1.0 / 2000};
        reference_bin_members(&bins, &sharp, members);
        assert_true(members[0] == 0);
        assert_true(members[5] == (kind == PARTITION_CAP ? 1 : 0));
    }
}

/// Materials at random, of every kind.
static lobe_scene *random_scene(uint64_t seed, uint32_t width, uint32_t height,
                                lobe_material *material) {
    lobe_scene *scene = scene_begin();
    if (seed % 2) {
        *material = half_vector_material(
            seed % 4 == 1 ? LOBE_DISTRIBUTION_VMF : LOBE_DISTRIBUTION_BLINN_PHONG, 20);
        material->lobe_count = 2;
        material->lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
        material->lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 0.5f, {0.1f, 0.2f, 0.3f}};
        material->width_map = scene_add_map(scene, random_map(height, 7, 0, 3, seed));
    } else {
        lobe_material_default(material);
        material->distribution = (lobe_distribution)(seed / 2 % 4);
        material->metallic_roughness_map = scene_add_map(scene, random_map(height, 7, 0, 1, seed));
    }
    material->normal_concentration = seed % 3 ? 0 : (float)seed / 10;
    material->normal_map =
        scene_add_map(scene, random_normal_map(width, height, seed % 5 ? 0.9 : 2.5, seed + 1));
    return scene;
}

/// No moment of any texel is outside [-1, 1], however base lobes are represented.
static void ranges_hold_all_lobes(void **state) {
    for (uint64_t seed = 400; seed < 424; seed++) {
        lobe_material material;
        lobe_scene *scene = random_scene(seed, 24, 20, &material);
        moment_partition partition =
            partition_of(*state, scene, &material, PARTITION_FITTED, 1, true);
        reference_moment_bins bins = moment_bins_of(&partition, 1);
        for (int as_lobe = 0; as_lobe < 2; as_lobe++) {
            reference_layers texels = moments_of_texels(scene, &material, &bins, as_lobe);
            for (uint32_t i = 0; i < texels.width * texels.height * 8; i++)
                if (!(fabs(texels.texels[i]) <= 1 + 1e-6))
                    fail_msg("material %u, number %u: %g", (unsigned)seed, i, texels.texels[i]);
            reference_layers_free(&texels);
        }
        lobe_scene_destroy(&scene);
    }
}

/// Between facets that lean to either side of an axis, the surface leans further along it than
/// they.
static void ranges_hold_what_lies_between_texels(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material;
    lobe_material_default(&material);
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 8, 8);
    for (uint32_t i = 0; i < 64; i++) {
        float *texel = (float *)image.texels + (size_t)4 * i;
        texel[0] = i % 8 < 4 ? 0.75f : 0.25f;
        texel[1] = i / 8 % 2 ? 0.75f : 0.25f;
        texel[2] = (float)(0.5 + sqrt(0.125));
    }
    material.normal_map = scene_add_map(scene, image);
    moment_partition partition = partition_of(*state, scene, &material, PARTITION_FITTED, 1, true);
    reference_moment_bins bins = moment_bins_of(&partition, 1);
    reference_layers texels = moments_of_texels(scene, &material, &bins, false);
    for (uint32_t i = 0; i < texels.width * texels.height * 8; i++)
        assert_true(fabs(texels.texels[i]) <= 1);
    reference_layers_free(&texels);
    lobe_scene_destroy(&scene);
}

static void the_same_every_time(void **state) {
    for (uint64_t seed = 430; seed < 434; seed++) {
        moment_partition partitions[2];
        for (int i = 0; i < 2; i++) {
            lobe_material material;
            lobe_scene *scene = random_scene(seed, 67, 45, &material);
            partitions[i] =
                partition_of(*state, scene, &material, PARTITION_FITTED, AUTOMATIC, false);
        }
        assert_memory_equal(&partitions[0], &partitions[1], sizeof *partitions);
    }
}

static void assert_sound(const moment_partition *partition) {
    const float mass = partition->constants.largest[0];
    assert_in_range(partition->bins, 1, MOMENT_MAXIMUM_BINS);
    assert_true(mass > 0 && isfinite(mass));
    for (uint32_t i = 0; i < partition->bins; i++) {
        const moment_bin *bin = &partition->constants.bins[i];
        assert_true(bin->range[2] > 0 && bin->range[3] > 0 && bin->shape[3] > 0);
        for (int j = 0; j < 4; j++)
            assert_true(isfinite(bin->centre[j]) && isfinite(bin->shape[j]) &&
                        isfinite(bin->range[j]) && isfinite(partition->constants.hats[j]));
    }
}

/// Of any size and width, and with normals that have no direction or point down.
static void any_map_has_a_partition(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 2}, {3, 5}, {25, 23}, {671, 3}};
    static const float widths[] = {0, 1e6f, 1e-3f};
    for (uint32_t i = 0; i < 15; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
        const uint32_t *size = sizes[i / 3];
        material.normal_map =
            scene_add_map(scene, i % 2 ? map_image(LOBE_FORMAT_RGBA32_FLOAT, size[0], size[1])
                                       : random_normal_map(size[0], size[1], 3.1, 441 + i));
        material.width_map = scene_add_map(scene, widths_in_turn(size[1], size[0], widths, 3));
        moment_partition partition = partition_of(*state, scene, &material, i % 3, i / 3, false);
        assert_sound(&partition);
    }
}

/// Normals in half floats, which the host does not read, from a map in floats.
static lobe_image half_map(const lobe_image *image) {
    lobe_image halves = map_image(LOBE_FORMAT_RGBA16_FLOAT, image->width, image->height);
    for (size_t i = 0; i < (size_t)4 * image->width * image->height; i++) {
        // Exact for the numbers below: sixteenths.
        static const uint16_t sixteenths[] = {0,      0x2c00, 0x3000, 0x3200, 0x3400, 0x3500,
                                              0x3600, 0x3700, 0x3800, 0x3880, 0x3900, 0x3980,
                                              0x3a00, 0x3a80, 0x3b00, 0x3b80, 0x3c00};
        ((uint16_t *)halves.texels)[i] =
            sixteenths[(int)lroundf(16 * ((const float *)image->texels)[i])];
    }
    return halves;
}

static lobe_frame draw_normals(fixture *f, const lobe_material *base, lobe_image image) {
    lobe_scene *scene = scene_begin();
    lobe_material material = *base;
    material.normal_map = scene_add_map(scene, image);
    scene_add_square(scene, &material, 20, NULL);
    scene_add_sun(scene, (double[]){0.2, 1, 0.1}, 1);
    scene_look_down(scene, 2);
    scene_end(scene);
    picture_request request = {
        .filter = "moments", .settings = {"bins=1"}, .width = 24, .height = 24, .samples = 1};
    lobe_frame frame = draw_scene(f, scene, &request);
    lobe_scene_destroy(&scene);
    return frame;
}

/// The device finds the bins, also where it is a single one.
static void unreadable_maps_are_drawn(void **state) {
    lobe_material materials[2] = {half_vector_material(LOBE_DISTRIBUTION_VMF, 60)};
    lobe_material_default(&materials[1]);
    materials[1].roughness = 0.4f;
    for (int i = 0; i < 2; i++) {
        lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 16, 16);
        for (uint32_t j = 0; j < 256; j++) {
            const float texels[2][4] = {{0.25f, 0.5f, 0.9375f, 1}, {0.5f, 0.625f, 1, 1}};
            memcpy((float *)image.texels + (size_t)4 * j, texels[j % 3 == 0], sizeof texels[0]);
        }
        lobe_image halves = half_map(&image);
        lobe_scene *scene = scene_begin();
        lobe_material material = materials[i];
        material.normal_map = scene_add_map(scene, half_map(&image));
        moment_partition partition =
            partition_of(*state, scene, &material, PARTITION_FITTED, AUTOMATIC, false);
        assert_sound(&partition);
        assert_false(partition.has_first);
        lobe_frame exact = draw_normals(*state, &materials[i], image);
        lobe_frame frame = draw_normals(*state, &materials[i], halves);
        assert_true(largest_value(&exact.radiance) > 0.05);
        double error = relative_l2(&frame.radiance, &exact.radiance);
        print_message("# in half floats: %.3g off\n", error);
        assert_true(error < 0.005);
        lobe_frame_free(&exact);
        lobe_frame_free(&frame);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_are_told_apart),
        cmocka_unit_test(widths_are_told_apart),
        cmocka_unit_test(as_many_bins_as_pay),
        cmocka_unit_test(sharp_lobes_of_many_directions_take_several_bins),
        cmocka_unit_test(lobes_that_are_hardly_seen_take_fewer_bins),
        cmocka_unit_test(few_rough_texels_among_polish_have_a_bin),
        cmocka_unit_test(the_less_fetches_must_gain_the_more_bins),
        cmocka_unit_test(small_footprints_take_bins_too),
        cmocka_unit_test(black_texels_decide_nothing),
        cmocka_unit_test(bins_have_colours_that_go_with_lobes),
        cmocka_unit_test(what_was_asked_for),
        cmocka_unit_test(ranges_hold_all_lobes),
        cmocka_unit_test(ranges_hold_what_lies_between_texels),
        cmocka_unit_test(the_same_every_time),
        cmocka_unit_test(any_map_has_a_partition),
        cmocka_unit_test(unreadable_maps_are_drawn),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
