// The filter "moments" through the whole renderer: against double precision, linear where theory
// requires it, with colours that stay with their directions, and the same in every storage format.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "passes/filters/moments/partition.h"
#include "passes/upload/scene_upload.h"
#include "tests/passes/support/moment_reference.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/vector.h"

static const double angles[] = {0, 35, 65, 80};
enum { PAIRS = 16 };

/// One light and one viewer for each pair of angles, in different planes.
static void directions_at(int i, double outgoing[3], double incoming[3]) {
    slope_plane_direction(angles[i / 4], 0.4, outgoing);
    slope_plane_direction(angles[i % 4], 0.4 + 0.7 * i, incoming);
}

/// Maps of a plane; a single pixel sees all texels, many times, and nothing between them.
typedef struct ground {
    lobe_material material;
    lobe_image normals, widths; ///< widths: may have no texels
    lobe_image colours;         ///< likewise; of microfacets
} ground;

static void ground_free(ground *g) {
    lobe_image_free(&g->normals);
    lobe_image_free(&g->widths);
    lobe_image_free(&g->colours);
}

static lobe_texture_use add_copy(lobe_scene *scene, const lobe_image *image) {
    if (!image->texels)
        return LOBE_TEXTURE_NONE;
    lobe_image copy = map_image(image->format, image->width, image->height);
    memcpy(copy.texels, image->texels,
           (size_t)copy.width * copy.height * lobe_format_size(copy.format));
    lobe_texture_use use = scene_add_map(scene, copy);
    use.nearest = true;
    return use;
}

/// Seen from `outgoing`, without a light. `mapped` receives the material with its maps.
static lobe_scene *plane_of(const ground *g, const double outgoing[3], lobe_material *mapped) {
    lobe_scene *scene = scene_begin();
    *mapped = g->material;
    mapped->normal_map = add_copy(scene, &g->normals);
    if (mapped->model == LOBE_MATERIAL_MICROFACET)
        mapped->metallic_roughness_map = add_copy(scene, &g->widths);
    else
        mapped->width_map = add_copy(scene, &g->widths);
    mapped->base_colour_map = add_copy(scene, &g->colours);
    scene_add_square(scene, mapped, 40, NULL);
    const double world[3] = {outgoing[0], outgoing[2], -outgoing[1]};
    scene_look_from(scene, world, 0.2);
    return scene;
}

/// The pixel under one light.
static void draw_pixel(fixture *f, const ground *g, const char *const settings[6],
                       const double outgoing[3], const double incoming[3], float found[3]) {
    lobe_material mapped;
    lobe_scene *scene = plane_of(g, outgoing, &mapped);
    slope_plane_add_sun(scene, incoming, 1);
    scene_end(scene);
    picture_request request = {.filter = "moments", .width = 1, .height = 1, .samples = 1};
    memcpy(request.settings, settings, 6 * sizeof *settings);
    lobe_frame frame = draw_scene(f, scene, &request);
    memcpy(found, pixel_at(&frame.radiance, 0, 0), 3 * sizeof *found);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Against double precision

/// How lobes are distributed over bins, for the filter and its reference.
typedef struct sharing {
    const char *what;
    const char *settings[6];
    uint32_t kind, bins; ///< as asked for
    bool colour;
} sharing;

static const sharing fitted = {"fitted bins",
                               {"storage=float32", "partition=fitted", "bins=3", "colour=mean"},
                               PARTITION_FITTED,
                               3,
                               false};
static const sharing one_bin = {"one bin",
                                {"storage=float32", "partition=fitted", "bins=1", "colour=mean"},
                                PARTITION_FITTED,
                                1,
                                false};
static const sharing chosen = {"as many bins as pay",
                               {"storage=float32", "partition=fitted", "bins=auto", "colour=mean"},
                               PARTITION_FITTED,
                               0,
                               false};
static const sharing coloured = {"coloured bins",
                                 {"storage=float32", "partition=fitted", "bins=2", "colour=bins"},
                                 PARTITION_FITTED,
                                 2,
                                 true};
static const sharing hats = {
    "hats", {"storage=float32", "partition=hats", "colour=mean"}, PARTITION_HATS, 0, false};
static const sharing cap = {
    "hats and a cap", {"storage=float32", "partition=cap", "colour=bins"}, PARTITION_CAP, 0, true};

enum { MOST_LAYERS = 3 * MOMENT_MAXIMUM_BINS + 1 };

/// The bins that the filter takes for the plane.
static reference_moment_bins bins_of(fixture *f, lobe_scene *scene, const sharing *how) {
    scene_end(scene);
    device_scene *uploaded;
    assert_int_equal(passes_device_scene_create(f->device, f->graph, scene, &f->host, &uploaded),
                     LOBE_OK);
    moment_partition partition;
    const partition_request request = {how->kind,
                                       {.bins = how->bins,
                                        .colour = how->colour ? BIN_COLOUR_OWN : BIN_COLOUR_MEAN,
                                        .gain = 0.115}};
    assert_int_equal(passes_moment_partition_make(uploaded, 0, &request, &f->host, &partition),
                     LOBE_OK);
    passes_device_scene_destroy(&uploaded);
    return moment_bins_of(&partition, 1);
}

/// The bins of a plane and the means of their moments.
static reference_moment_bins moments_of(fixture *f, const ground *g, const sharing *how,
                                        lobe_material *mapped, double moments[4 * MOST_LAYERS]) {
    lobe_scene *scene = plane_of(g, (double[]){0, 0, 1}, mapped);
    reference_moment_bins bins = bins_of(f, scene, how);
    reference_layers texels = moments_of_texels(scene, mapped, &bins, false);
    reference_mean(&texels, moments);
    reference_layers_free(&texels);
    lobe_scene_destroy(&scene);
    return bins;
}

static void check_pixel(const float found[3], const double expected[3], double tolerance,
                        const char *what, const char *how, int pair) {
    for (int i = 0; i < 3; i++) {
        if (!(fabs((double)found[i] - expected[i]) <= tolerance * expected[i] + 2e-6))
            fail_msg("%s, %s, from %g to %g degrees, channel %d: %.7g instead of %.7g", what, how,
                     angles[pair % 4], angles[pair / 4], i, (double)found[i], expected[i]);
    }
}

static void check_shading(fixture *f, const ground *g, const sharing *how, const char *what) {
    lobe_material mapped;
    double moments[4 * MOST_LAYERS], brightest = 0;
    reference_moment_bins bins = moments_of(f, g, how, &mapped, moments);
    for (int i = 0; i < PAIRS; i += 3) {
        double outgoing[3], incoming[3], expected[3];
        float found[3];
        directions_at(i, outgoing, incoming);
        draw_pixel(f, g, how->settings, outgoing, incoming, found);
        shade_moments(&mapped, &bins, moments, outgoing, incoming, expected);
        check_pixel(found, expected, 1e-3, what, how->what, i);
        brightest = fmax(brightest, expected[1]);
    }
    assert_true(brightest > 0.01);
}

/// Roughness, and metal in every texel or in some.
static lobe_image roughness_map(bool metal_varies, uint64_t seed) {
    lobe_image image = random_map(8, 8, 0.3, 1, seed);
    float *texel = image.texels;
    for (int i = 0; i < 8 * 8 && !metal_varies; i++, texel += 4)
        texel[2] = 1;
    return image;
}

static void microfacets_are_shaded_by_their_moments(void **state) {
    static const sharing *const ways[] = {&fitted, &one_bin, &coloured, &hats, &cap, &chosen};
    for (int i = 0; i < 6; i++) {
        static const lobe_distribution distributions[] = {LOBE_DISTRIBUTION_BECKMANN,
                                                          LOBE_DISTRIBUTION_GGX};
        for (int j = 0; j < 2; j++) {
            ground g = {.material = microfacet_material(distributions[j], 0.7, 0.4),
                        .normals = (i + j) % 2 ? slope_plane_leaning_map(401)
                                               : random_normal_map(8, 8, 0.7, 402),
                        .widths = roughness_map(ways[i]->colour, 403)};
            g.material.base_colour[1] = 0.5f;
            // With one roughness, the bin for rough lobes is empty.
            if (ways[i] == &hats && j == 1)
                lobe_image_free(&g.widths);
            check_shading(*state, &g, ways[i], j ? "GGX" : "Beckmann");
            ground_free(&g);
        }
    }
}

/// Two lobes that lean to different sides, over a Lambert part.
static lobe_material leaning_lobes(lobe_distribution distribution) {
    lobe_material material = half_vector_material(distribution, 40);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 15, {0.25f, 0.125f, 0.0625f}};
    material.base_colour[1] = 0.5f;
    return material;
}

static void lobes_are_shaded_by_their_moments(void **state) {
    static const sharing *const ways[] = {&fitted, &coloured, &hats, &cap};
    for (int i = 0; i < 4; i++) {
        ground g = {.material = leaning_lobes(i % 2 ? LOBE_DISTRIBUTION_VMF
                                                    : LOBE_DISTRIBUTION_BLINN_PHONG),
                    .normals = random_normal_map(8, 8, 0.5, 411),
                    .widths = random_map(8, 8, 0.5, 3, 412)};
        check_shading(*state, &g, ways[i], i % 2 ? "vMF lobes" : "Blinn-Phong lobes");
        ground_free(&g);
    }
}

/// More lights than are prepared at once.
static void lights_add_up(void **state) {
    enum { LIGHTS = 6 };
    ground g = {.material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.7, 0.4),
                .normals = slope_plane_leaning_map(421),
                .widths = roughness_map(true, 422)};
    lobe_material mapped;
    double moments[4 * MOST_LAYERS], sum[3] = {0}, outgoing[3];
    reference_moment_bins bins = moments_of(*state, &g, &coloured, &mapped, moments);
    slope_plane_direction(35, 0.4, outgoing);
    lobe_scene *scene = plane_of(&g, outgoing, &mapped);
    for (int i = 0; i < LIGHTS; i++) {
        double incoming[3], expected[3];
        slope_plane_direction(12 * i, 1.3 * i, incoming);
        slope_plane_add_sun(scene, incoming, 1 + i);
        shade_moments(&mapped, &bins, moments, outgoing, incoming, expected);
        for (int j = 0; j < 3; j++)
            sum[j] += (1 + i) * expected[j];
    }
    scene_end(scene);
    picture_request request = {.filter = "moments", .width = 1, .height = 1, .samples = 1};
    memcpy(request.settings, coloured.settings, sizeof coloured.settings);
    lobe_frame frame = draw_scene(*state, scene, &request);
    check_pixel(pixel_at(&frame.radiance, 0, 0), sum, 1e-3, "GGX", "six lights", 4);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    ground_free(&g);
}

/// Of roughness 1, which glTF's materials have if they do not say: the broadest lobes there are.
static void the_roughest_metal_is_as_bright_as_its_texels(void **state) {
    enum { EXTENT = 64 };
    static const double slope = 0.25, tolerance = 0.03;
    const lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    lobe_image normals = slope_plane_bumpy_map(EXTENT, slope);
    for (int i = 0; i < 4; i++) {
        double outgoing[3], incoming[3];
        float found[3];
        slope_plane_direction(i < 2 ? 0 : 40, 0.3, outgoing);
        slope_plane_direction(i % 2 ? 50 : 10, 1.5, incoming);
        slope_plane_draw_lit(*state, &material, &normals, "moments", NULL, outgoing, incoming,
                             found);
        const double expected =
            slope_plane_bumpy_radiance(&material, EXTENT, slope, outgoing, incoming);
        if (!(fabs((double)found[1] / expected - 1) < tolerance))
            fail_msg("view and light %d: %g instead of %g", i, (double)found[1], expected);
    }
    lobe_image_free(&normals);
}

// ---------------------------------------------------------------------------------------------
// Linearity

/// A normal of one side: the next column of texels leans the other way in a sawtooth.
static void facet_normal(int side, double degrees, double normal[3]) {
    double angle = degrees * M_PI / 180;
    normal[0] = side ? sin(angle) : -sin(angle);
    normal[1] = 0;
    normal[2] = cos(angle);
}

static void put_normal(lobe_image *image, int x, int y, const double normal[3]) {
    float *texel = (float *)image->texels + (size_t)4 * ((uint32_t)y * image->width + (uint32_t)x);
    for (int i = 0; i < 3; i++)
        texel[i] = (float)(0.5 + 0.5 * normal[i]);
}

/// 8x8 texels, of which the first `columns` lean to the left.
static lobe_image two_sides(int columns, double degrees) {
    lobe_image image = constant_map(8, 8, 0.5f, 0.5f, 1);
    for (int i = 0; i < 64; i++) {
        double normal[3];
        facet_normal(i % 8 >= columns, degrees, normal);
        put_normal(&image, i % 8, i / 8, normal);
    }
    return image;
}

/// Bins that keep the two sides apart: their sum is that of the sides' own pictures, each with as
/// much weight as it has texels. Of microfacets only where one side alone reflects (masking is that
/// of all that reflect together): there, the picture is that side's part.
static void check_mean_of_two(fixture *f, const lobe_material *material, int columns,
                              const char *what) {
    static const char *const settings[6] = {"storage=float32", "bins=2", "colour=mean"};
    ground g[3];
    for (int i = 0; i < 3; i++)
        g[i] = (ground){.material = *material,
                        .normals = two_sides(i == 0   ? columns
                                             : i == 1 ? 8
                                                      : 0,
                                             25)};
    double brightest = 0;
    // Half vectors from one side's normal to the other's; the viewer is upright.
    for (int tilt = -60; tilt <= 60; tilt += 20) {
        double outgoing[3] = {0, 0, 1}, incoming[3], expected[3];
        float found[3], left[3], right[3];
        slope_plane_direction(tilt, 0, incoming);
        draw_pixel(f, &g[0], settings, outgoing, incoming, found);
        draw_pixel(f, &g[1], settings, outgoing, incoming, left);
        draw_pixel(f, &g[2], settings, outgoing, incoming, right);
        for (int i = 0; i < 3; i++) {
            double share = columns / 8.0;
            expected[i] = share * (double)left[i] + (1 - share) * (double)right[i];
            brightest = fmax(brightest, expected[i]);
            if (!(fabs((double)found[i] - expected[i]) <= 2e-3 * expected[i] + 1e-5))
                fail_msg("%s, %d columns, light at %d degrees, channel %d: %.7g instead of %.7g",
                         what, columns, tilt, i, (double)found[i], expected[i]);
        }
    }
    assert_true(brightest > 0.1);
    for (int i = 0; i < 3; i++)
        ground_free(&g[i]);
}

static void two_sides_are_the_mean_of_both(void **state) {
    lobe_material lobes = half_vector_material(LOBE_DISTRIBUTION_VMF, 60);
    check_mean_of_two(*state, &lobes, 4, "vMF");
    check_mean_of_two(*state, &lobes, 2, "vMF");
    lobe_material blinn_phong = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 60);
    check_mean_of_two(*state, &blinn_phong, 6, "Blinn-Phong");
    lobe_material metal = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.35, 1);
    check_mean_of_two(*state, &metal, 4, "Beckmann");
    check_mean_of_two(*state, &metal, 2, "Beckmann");
}

/// Sides that overlap, with their own widths and metalness: the filter's result for both equals
/// that of the weighted sum of each side's moments in the common bins.
static void moments_of_two_sides_add_up(void **state) {
    ground both = {.material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1),
                   .normals = two_sides(2, 15),
                   .widths = constant_map(8, 8, 1, 0.4f, 1)};
    for (int i = 0; i < 64; i++) {
        float *texel = (float *)both.widths.texels + (size_t)4 * i;
        if (i % 8 >= 2)
            texel[1] = 0.7f, texel[2] = 0.25f;
    }
    lobe_material mapped;
    double moments[4 * MOST_LAYERS], sum[4 * MOST_LAYERS] = {0};
    reference_moment_bins bins = moments_of(*state, &both, &coloured, &mapped, moments);
    for (int side = 0; side < 2; side++) {
        ground one = {.material = both.material,
                      .normals = two_sides(side ? 0 : 8, 15),
                      .widths = constant_map(8, 8, 1, side ? 0.7f : 0.4f, side ? 0.25f : 1)};
        lobe_scene *scene = plane_of(&one, (double[]){0, 0, 1}, &mapped);
        reference_layers texels = moments_of_texels(scene, &mapped, &bins, false);
        reference_mean(&texels, moments);
        for (uint32_t i = 0; i < 4 * reference_moment_layers(&bins); i++)
            sum[i] += (side ? 0.75 : 0.25) * moments[i];
        reference_layers_free(&texels);
        lobe_scene_destroy(&scene);
        ground_free(&one);
    }
    for (int i = 0; i < PAIRS; i += 3) {
        double outgoing[3], incoming[3], expected[3];
        float found[3];
        directions_at(i, outgoing, incoming);
        draw_pixel(*state, &both, coloured.settings, outgoing, incoming, found);
        shade_moments(&mapped, &bins, sum, outgoing, incoming, expected);
        check_pixel(found, expected, 1e-3, "two sides", "summed", i);
    }
    ground_free(&both);
}

// ---------------------------------------------------------------------------------------------
// Colour

static const float side_colours[2][3] = {{0.9f, 0.1f, 0.1f}, {0.1f, 0.1f, 0.9f}};

/// Red metal that leans to the left, blue metal that leans to the right.
static ground two_coloured_sawtooth(double degrees) {
    ground g = {.material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 1),
                .normals = map_image(LOBE_FORMAT_RGBA32_FLOAT, 8, 8),
                .colours = constant_map(8, 8, 0, 0, 0)};
    for (int i = 0; i < 64; i++) {
        double normal[3];
        facet_normal(i % 2, degrees, normal);
        put_normal(&g.normals, i % 8, i / 8, normal);
        memcpy((float *)g.colours.texels + (size_t)4 * i, side_colours[i % 2],
               sizeof side_colours[0]);
    }
    return g;
}

/// The texels' mean reflection.
static void mean_of_texels(const ground *g, double degrees, const double outgoing[3],
                           const double incoming[3], double mean[3]) {
    mean[0] = mean[1] = mean[2] = 0;
    for (int side = 0; side < 2; side++) {
        double normal[3], radiance[3];
        lobe_material material = g->material;
        memcpy(material.base_colour, side_colours[side], sizeof side_colours[0]);
        facet_normal(side, degrees, normal);
        shade_base_material(&material, normal, outgoing, incoming, radiance);
        for (int i = 0; i < 3; i++)
            mean[i] += 0.5 * radiance[i];
    }
}

static void bins_keep_colours_with_directions(void **state) {
    static const char *const in_bins[6] = {"colour=bins"}, *const in_the_mean[6] = {"colour=mean"};
    ground g = two_coloured_sawtooth(20);
    for (int side = 0; side < 2; side++) {
        double outgoing[3] = {0, 0, 1}, incoming[3], exact[3];
        float own[3], mean[3];
        int lit = side ? 2 : 0;
        // What facets of that side reflect to the viewer.
        slope_plane_direction(side ? 40 : -40, 0, incoming);
        mean_of_texels(&g, 20, outgoing, incoming, exact);
        draw_pixel(*state, &g, in_bins, outgoing, incoming, own);
        draw_pixel(*state, &g, in_the_mean, outgoing, incoming, mean);
        print_message("# lit from the %s: %g %g %g; bins %g %g %g, mean %g %g %g\n",
                      side ? "right" : "left", exact[0], exact[1], exact[2], (double)own[0],
                      (double)own[1], (double)own[2], (double)mean[0], (double)mean[1],
                      (double)mean[2]);
        // The other colour is at most a seventh of the right one.
        assert_true(exact[2 - lit] < 0.15 * exact[lit]);
        for (int i = 0; i < 3; i++)
            assert_true(fabs((double)own[i] - exact[i]) <= 0.02 * exact[lit]);
        // The mean of both colours is magenta, whichever side is lit.
        assert_true(fabsf(mean[0] - mean[2]) <= 0.02f * mean[0]);
        assert_true((double)mean[lit] < 0.6 * exact[lit]);
        assert_true((double)mean[2 - lit] > 3 * exact[2 - lit]);
    }
    ground_free(&g);
}

// ---------------------------------------------------------------------------------------------
// Storage and knobs

enum { WIDTH = 24, HEIGHT = 16 };

/// A square of dielectric and metal, near and far at once.
static lobe_scene *varied_square(void) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.5, 431));
    material.metallic_roughness_map = scene_add_map(scene, random_map(64, 64, 0.2, 1, 432));
    scene_add_square(scene, &material, 4, NULL);
    scene_look_along(scene);
    scene_end(scene);
    return scene;
}

static lobe_frame draw_varied(fixture *f, const char *const settings[5]) {
    picture_request request = {
        .filter = "moments", .width = WIDTH, .height = HEIGHT, .samples = 1, .outputs = true};
    memcpy(request.settings, settings, 5 * sizeof *settings);
    return draw(f, &request);
}

static void storages_are_close(void **state) {
    fixture *f = *state;
    lobe_scene *scene = varied_square();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    static const char *const partitions[] = {"partition=fitted", "partition=hats", "partition=cap"};
    for (int i = 0; i < 3; i++) {
        lobe_frame frames[3];
        static const char *const storages[] = {"storage=float32", "storage=snorm16",
                                               "storage=float16"};
        for (int j = 0; j < 3; j++)
            frames[j] = draw_varied(f, (const char *const[5]){partitions[i], storages[j]});
        double fixed = relative_l2(&frames[1].radiance, &frames[0].radiance);
        double half = relative_l2(&frames[2].radiance, &frames[0].radiance);
        print_message("# %s: snorm16 %.3g, float16 %.3g\n", partitions[i], fixed, half);
        assert_true(fixed > 0 && fixed <= 4e-3);
        assert_true(half > 0 && half <= 1.5e-3);
        for (int j = 0; j < 3; j++)
            lobe_frame_free(&frames[j]);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Combinations of knobs at their limits, which varying one at a time does not reach.
static void knobs_at_their_ends_together(void **state) {
    static const char *const settings[][5] = {
        {"bins=1", "colour=bins", "storage=snorm16", "least_share=0.1"},
        {"bins=6", "colour=bins", "storage=snorm16", "least_share=0.1"},
        {"bins=6", "colour=bins", "storage=float16", "least_share=0"},
        {"bins=6", "colour=mean", "probes=16", "curvature=1"},
        {"partition=cap", "colour=bins", "least_share=0.1", "probes=16"},
        {"partition=hats", "colour=bins", "storage=float16", "least_share=0"},
    };
    fixture *f = *state;
    lobe_scene *scene = varied_square();
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        lobe_frame frame = draw_varied(f, settings[i]);
        assert_true(all_finite(&frame.radiance));
        assert_true(all_finite(&frame.normal_depth));
        assert_true(all_finite(&frame.lobes_level));
        assert_true(largest_value(&frame.radiance) > 0.01);
        lobe_frame_free(&frame);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    assert_int_equal(f->errors, 0);
}

/// Skipped bins are a small part of the footprint, however broad and massive other texels' lobes
/// are.
static void small_shares_alone_are_passed_over(void **state) {
    static const char *const all[6] = {"bins=3", "colour=mean", "least_share=0"};
    static const char *const most[6] = {"bins=3", "colour=mean", "least_share=0.1"};
    ground g = {.material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1),
                .normals = random_normal_map(8, 8, 0.4, 441),
                .widths = constant_map(8, 8, 1, 0.4f, 1)};
    ((float *)g.widths.texels)[1] = 1;
    for (int i = 0; i < PAIRS; i += 5) {
        double outgoing[3], incoming[3];
        float found[3], expected[3];
        directions_at(i, outgoing, incoming);
        draw_pixel(*state, &g, all, outgoing, incoming, expected);
        draw_pixel(*state, &g, most, outgoing, incoming, found);
        if (!((double)found[0] >= 0.8 * (double)expected[0] && expected[0] > 0))
            fail_msg("from %g to %g degrees: %g of %g is left", angles[i % 4], angles[i / 4],
                     (double)found[0], (double)expected[0]);
    }
    ground_free(&g);
}

// ---------------------------------------------------------------------------------------------
// Samples of a map

/// Stone with grit under pools of water: roughness 0.1 to 0.6. The map is moved by `shift` texels
/// along both axes.
static ground wet_stone(int shift) {
    enum { EXTENT = 128 };
    ground g = {.material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 0),
                .normals = constant_map(EXTENT, EXTENT, 0.5f, 0.5f, 1),
                .widths = constant_map(EXTENT, EXTENT, 1, 1, 0)};
    for (int i = 0; i < EXTENT * EXTENT; i++) {
        const int x = (i % EXTENT + shift) % EXTENT, y = (i / EXTENT + shift) % EXTENT;
        const double across = 2 * M_PI * x / EXTENT, down = 2 * M_PI * y / EXTENT;
        const double height = sin(across) + sin(down + 1) + 0.5 * sin(3 * across - 2 * down);
        const double dry = fmin(fmax(2 * (height - 0.9), 0), 1);
        const uint64_t number = 3 * (uint64_t)(x + y * EXTENT);
        const double tilt = passes_hashed_number(number) < 0.15 ? 15 : 0;
        double normal[3];
        slope_plane_direction(tilt * passes_hashed_number(number + 1),
                              2 * M_PI * passes_hashed_number(number + 2), normal);
        put_normal(&g.normals, i % EXTENT, i / EXTENT, normal);
        ((float *)g.widths.texels)[4 * i + 1] = (float)(0.1 + 0.5 * dry);
    }
    return g;
}

/// Bins are fitted to other texels of a map that is moved, and are not as many for each of these.
static void samples_of_a_map_give_about_the_same_picture(void **state) {
    enum { SHIFTS = 4, LIGHTS = 6 };
    double least[LIGHTS], most[LIGHTS];
    for (int i = 0; i < SHIFTS; i++) {
        ground g = wet_stone(29 * i);
        for (int light = 0; light < LIGHTS; light++) {
            double outgoing[3], incoming[3];
            float found[3];
            slope_plane_direction(20, 0.4, outgoing);
            slope_plane_direction(20 - 18 * light, 0.4, incoming);
            draw_pixel(*state, &g, chosen.settings, outgoing, incoming, found);
            least[light] = fmin(i ? least[light] : INFINITY, (double)found[0]);
            most[light] = fmax(i ? most[light] : 0, (double)found[0]);
        }
        ground_free(&g);
    }
    for (int light = 0; light < LIGHTS; light++)
        if (!(least[light] > 0.05 && most[light] <= 1.03 * least[light]))
            fail_msg("light %d: %g to %g", light, least[light], most[light]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(microfacets_are_shaded_by_their_moments),
        cmocka_unit_test(lobes_are_shaded_by_their_moments),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(the_roughest_metal_is_as_bright_as_its_texels),
        cmocka_unit_test(two_sides_are_the_mean_of_both),
        cmocka_unit_test(moments_of_two_sides_add_up),
        cmocka_unit_test(bins_keep_colours_with_directions),
        cmocka_unit_test(storages_are_close),
        cmocka_unit_test(samples_of_a_map_give_about_the_same_picture),
        cmocka_unit_test(small_shares_alone_are_passed_over),
        cmocka_unit_test(knobs_at_their_ends_together),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
