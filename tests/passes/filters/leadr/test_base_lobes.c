// Base lobes that go with colours, through the whole renderer, against the mean over the texels:
// rusted metal, and metal with a dark and rough patina.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/vector.h"

enum { EXTENT = 16 };

typedef struct metal_texel {
    double roughness, metallic, colour[3];
} metal_texel;

typedef metal_texel metal_pattern(uint32_t texel);

/// What is drawn.
typedef struct metal {
    metal_pattern *texel_at;
    double metallic, colour; ///< factors of the material
    bool masked;             ///< has holes
} metal;

/// From rust to steel, with places that are neither; roughness varies by itself, too.
static metal_texel rust_at(uint32_t texel) {
    const double steel = passes_hashed_number(2 * texel + 1),
                 noise = passes_hashed_number(2 * texel + 2);
    const double part = steel * steel * (3 - 2 * steel);
    return (metal_texel){.roughness = 0.8 - 0.4 * part + 0.15 * (noise - 0.5),
                         .metallic = part,
                         .colour = {0.2 + 0.4 * part, 0.1 + 0.5 * part, 0.05 + 0.5 * part}};
}

/// All of it is metal, of a colour map alone.
static metal_texel patina_at(uint32_t texel) {
    const double gold = passes_hashed_number(2 * texel + 1);
    return (metal_texel){.roughness = 0.75 - 0.35 * gold,
                         .metallic = 1,
                         .colour = {0.08 + 0.9 * gold, 0.05 + 0.6 * gold, 0.03 + 0.3 * gold}};
}

static metal_texel black_at(uint32_t texel) {
    return (metal_texel){.roughness = 0.3 + 0.3 * passes_hashed_number(texel), .metallic = 1};
}

static bool is_hole(const metal *drawn, uint32_t texel) {
    return drawn->masked && texel % 16 == 5;
}

/// Holes are of what shows most.
static metal_texel texel_of(const metal *drawn, uint32_t texel) {
    if (is_hole(drawn, texel))
        return (metal_texel){.roughness = 0.2, .metallic = 1, .colour = {1, 1, 1}};
    return drawn->texel_at(texel);
}

static void add_maps(lobe_scene *scene, const metal *drawn, lobe_material *material) {
    lobe_image colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT),
               widths = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const metal_texel texel = texel_of(drawn, i);
        float *colour = (float *)colours.texels + (size_t)4 * i;
        float *width = (float *)widths.texels + (size_t)4 * i;
        for (int j = 0; j < 3; j++)
            colour[j] = (float)texel.colour[j];
        width[1] = (float)texel.roughness;
        width[2] = (float)texel.metallic;
        width[0] = width[3] = 1;
        colour[3] = is_hole(drawn, i) ? 0 : 1;
    }
    material->base_colour_map = scene_add_map(scene, colours);
    material->metallic_roughness_map = scene_add_map(scene, widths);
    material->base_colour_map.nearest = material->metallic_roughness_map.nearest = true;
}

/// Over the plane z = 0.
static void mean_of_texels(const metal *drawn, const double outgoing[3], const double incoming[3],
                           double radiance[3]) {
    static const double normal[3] = {0, 0, 1};
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    double kept = 0, sums[3] = {0};
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        if (is_hole(drawn, i))
            continue;
        const metal_texel texel = drawn->texel_at(i);
        const double metallic = drawn->metallic * texel.metallic;
        kept++;
        const double alpha = texel.roughness * texel.roughness;
        const double distribution =
            reference_normal_distribution(LOBE_DISTRIBUTION_GGX, normal, half_vector, alpha);
        const double visible =
            reference_masking_shadowing(LOBE_DISTRIBUTION_GGX, incoming[2], outgoing[2], alpha);
        for (int j = 0; j < 3; j++) {
            const double colour = drawn->colour * texel.colour[j];
            const double f0 = 0.04 * (1 - metallic) + colour * metallic;
            const double fresnel = reference_fresnel(f0, 1, reference_dot(incoming, half_vector));
            sums[j] += reference_microfacet_specular(fresnel, distribution, visible, outgoing[2]) +
                       reference_microfacet_diffuse(colour * (1 - metallic), fresnel, incoming[2]);
        }
    }
    for (int j = 0; j < 3; j++)
        radiance[j] = sums[j] / kept;
}

/// The viewer is above, and the light at an angle from there. World: y is up.
static void draw_metal(fixture *f, const metal *drawn, const char *filter, double degrees,
                       float radiance[3]) {
    const bool bins = strcmp(filter, "moments") == 0;
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    for (int j = 0; j < 3; j++)
        material.base_colour[j] = (float)drawn->colour;
    material.metallic = (float)drawn->metallic;
    material.alpha_mask = drawn->masked;
    material.alpha_cutoff = 0.5f;
    add_maps(scene, drawn, &material);
    scene_add_square(scene, &material, 40, NULL);
    scene_look_from(scene, (double[]){sin(0.1), cos(0.1), 0}, 0.2);
    const double angle = degrees * M_PI / 180;
    scene_add_sun(scene, (double[]){sin(angle), cos(angle), 0}, 1);
    scene_end(scene);
    const picture_request request = {
        .filter = filter,
        .width = 1,
        .height = 1,
        .settings = {bins ? "bins=1" : NULL, bins ? "colour=bins" : NULL}};
    lobe_frame frame = draw_scene(f, scene, &request);
    memcpy(radiance, pixel_at(&frame.radiance, 0, 0), 3 * sizeof *radiance);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void must_be_mean(fixture *f, const metal *drawn, const char *filter, double tolerance) {
    static const double angles[] = {6, 20, 35, 50, 65, 75};
    for (int i = 0; i < 6; i++) {
        const double angle = angles[i] * M_PI / 180;
        double expected[3];
        float found[3];
        mean_of_texels(drawn, (double[]){sin(0.1), 0, cos(0.1)},
                       (double[]){sin(angle), 0, cos(angle)}, expected);
        draw_metal(f, drawn, filter, angles[i], found);
        for (int j = 0; j < 3; j++) {
            // Next to the viewer, black metal has less light than 1 - cos has digits.
            if (!(fabs((double)found[j] - expected[j]) <= tolerance * expected[j] + 1e-20))
                fail_msg("%s, %g degrees, channel %d: %.6g instead of %.6g", filter, angles[i], j,
                         (double)found[j], expected[j]);
        }
    }
}

/// Of `lobes`, those of one direction have one width.
static void must_be_mean_in_all_filters(fixture *f, const metal *drawn, double tolerance_of_lobes) {
    must_be_mean(f, drawn, "leadr", 0.08);
    must_be_mean(f, drawn, "multi_leadr", 0.08);
    must_be_mean(f, drawn, "lobes", tolerance_of_lobes);
    must_be_mean(f, drawn, "moments", 0.15);
}

/// One lobe of the mean variance of all texels in the mean colour is 0.6 of the highlight, and 1.4
/// times what is around it.
static void rusted_metal_is_the_mean_of_its_texels(void **state) {
    must_be_mean_in_all_filters(*state, &(metal){rust_at, 1, 1, false}, 0.27);
}

static void metal_with_patina_is_the_mean_of_its_texels(void **state) {
    must_be_mean_in_all_filters(*state, &(metal){patina_at, 1, 1, false}, 0.27);
}

/// Colours count with the material's own: here steel mirrors about as much as rust.
static void darkened_metal_is_the_mean_of_its_texels(void **state) {
    must_be_mean_in_all_filters(*state, &(metal){rust_at, 1, 0.1, false}, 0.4);
}

static void metal_with_holes_is_the_mean_of_what_is_kept(void **state) {
    must_be_mean_in_all_filters(*state, &(metal){patina_at, 1, 1, true}, 0.27);
}

/// It mirrors grazing light alone, of which smooth texels mirror more than rough ones.
static void black_metal_is_the_mean_of_its_texels(void **state) {
    const metal black = {black_at, 1, 1, false};
    must_be_mean(*state, &black, "leadr", 0.12);
    must_be_mean(*state, &black, "multi_leadr", 0.08);
    must_be_mean(*state, &black, "lobes", 0.2);
    must_be_mean(*state, &black, "moments", 0.15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rusted_metal_is_the_mean_of_its_texels),
        cmocka_unit_test(metal_with_patina_is_the_mean_of_its_texels),
        cmocka_unit_test(darkened_metal_is_the_mean_of_its_texels),
        cmocka_unit_test(metal_with_holes_is_the_mean_of_what_is_kept),
        cmocka_unit_test(black_metal_is_the_mean_of_its_texels),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
