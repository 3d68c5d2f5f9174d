// Materials that are metal in places, through the whole renderer: what filters reflect of gold
// between black and blue paint, against the mean over its texels.

#include <math.h>
#include <stdlib.h>

#include "passes/maps/colours/metal_means.h"
#include "shaders/interface/lobe_grid.h"
#include "tests/passes/support/map_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/microfacet/microfacet.h"
#include "tests/reference/vector.h"

enum { EXTENT = 16 };

typedef struct paint_texel {
    double metallic, colour[3];
} paint_texel;

/// Colours go with metal, or are those of gold everywhere.
static paint_texel paint_at(uint32_t texel, bool coloured) {
    static const paint_texel texels[4] = {
        {1, {1, 0.75, 0.3}}, {0, {0.02, 0.02, 0.02}}, {1, {1, 0.75, 0.3}}, {0, {0.1, 0.2, 0.8}}};
    paint_texel found = texels[texel % 4];
    for (int j = 0; j < 3 && !coloured; j++)
        found.colour[j] = texels[0].colour[j];
    return found;
}

/// `finer`: colours have as many times the texels on each side.
static void add_maps(lobe_scene *scene, lobe_material *material, bool coloured, uint32_t finer) {
    const uint32_t side = finer * EXTENT;
    lobe_image colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, side, side),
               widths = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const paint_texel texel = paint_at(i, true);
        float *width = (float *)widths.texels + (size_t)4 * i;
        width[1] = 1;
        width[2] = (float)texel.metallic;
        width[0] = width[3] = 1;
    }
    for (uint32_t i = 0; i < side * side; i++) {
        const paint_texel texel = paint_at(i / side / finer * EXTENT + i % side / finer, true);
        float *colour = (float *)colours.texels + (size_t)4 * i;
        for (int j = 0; j < 3; j++)
            colour[j] = (float)texel.colour[j];
        colour[3] = 1;
    }
    if (coloured) {
        material->base_colour_map = scene_add_map(scene, colours);
        material->base_colour_map.nearest = true;
    } else {
        lobe_image_free(&colours);
    }
    material->metallic_roughness_map = scene_add_map(scene, widths);
    material->metallic_roughness_map.nearest = true;
}

/// Over the plane z = 0.
static void mean_of_texels(const lobe_material *material, bool coloured, const double outgoing[3],
                           const double incoming[3], double radiance[3]) {
    static const double normal[3] = {0, 0, 1};
    const double alpha = (double)material->roughness * (double)material->roughness;
    double half_vector[3];
    half_between(incoming, outgoing, half_vector);
    const double distribution =
        reference_normal_distribution(LOBE_DISTRIBUTION_BECKMANN, normal, half_vector, alpha);
    const double visible =
        reference_masking_shadowing(LOBE_DISTRIBUTION_BECKMANN, incoming[2], outgoing[2], alpha);
    radiance[0] = radiance[1] = radiance[2] = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const paint_texel texel = paint_at(i, coloured);
        const double metallic = texel.metallic * (double)material->metallic;
        for (int j = 0; j < 3; j++) {
            const double colour = coloured ? texel.colour[j] * (double)material->base_colour[j]
                                           : (double)material->base_colour[j];
            const double f0 = 0.04 * (1 - metallic) + colour * metallic;
            const double fresnel = reference_fresnel(f0, 1, reference_dot(incoming, half_vector));
            radiance[j] +=
                (reference_microfacet_specular(fresnel, distribution, visible, outgoing[2]) +
                 reference_microfacet_diffuse(colour * (1 - metallic), fresnel, incoming[2])) /
                (EXTENT * EXTENT);
        }
    }
}

typedef struct metal_case {
    const char *filter;
    bool coloured;
    double metallic, tint; ///< factors of the material
    uint32_t finer;        ///< as add_maps
    bool by_vertices;      ///< the tint is that of the mesh, in bins of their own colours
} metal_case;

/// Gives the vertices the colour that the material has.
static void tint_mesh(lobe_scene *scene, float tint) {
    for (int j = 0; j < 3; j++)
        scene->materials[0].base_colour[j] = 1;
    for (size_t i = 0; i < scene->meshes[0].vertex_count; i++)
        for (int j = 0; j < 3; j++)
            scene->meshes[0].vertices[i].colour[j] = tint;
    scene->meshes[0].has_colour = true;
}

/// The viewer is above, and the light at an angle from there. World: y is up.
static void check_case(fixture *f, const metal_case *tested) {
    static const double angles[] = {6, 30, 60};
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 0.6, tested->metallic);
    for (int j = 0; j < 3; j++)
        material.base_colour[j] = (float)tested->tint;
    add_maps(scene, &material, tested->coloured, tested->finer);
    scene_add_square(scene, &material, 40, NULL);
    scene_look_from(scene, (double[]){sin(0.1), cos(0.1), 0}, 0.2);
    scene_add_sun(scene, (double[]){0, 1, 0}, 1);
    if (tested->by_vertices)
        tint_mesh(scene, (float)tested->tint);
    scene_end(scene);
    for (int i = 0; i < 3; i++) {
        const double angle = angles[i] * M_PI / 180;
        const picture_request request = {.filter = tested->filter,
                                         .settings = {tested->by_vertices ? "colour=bins" : NULL},
                                         .width = 1,
                                         .height = 1};
        double expected[3];
        scene->lights[0].direction[0] = (float)-sin(angle);
        scene->lights[0].direction[1] = (float)-cos(angle);
        lobe_frame frame = draw_scene(f, scene, &request);
        mean_of_texels(&material, tested->coloured, (double[]){sin(0.1), 0, cos(0.1)},
                       (double[]){sin(angle), 0, cos(angle)}, expected);
        for (int j = 0; j < 3; j++) {
            const double found = (double)pixel_at(&frame.radiance, 0, 0)[j];
            if (!(fabs(found - expected[j]) <= 0.02 * expected[j]))
                fail_msg("%s, %g degrees, channel %d: %.6g instead of %.6g", tested->filter,
                         angles[i], j, found, expected[j]);
        }
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
}

/// Of mean colour times mean metal, the highlight is 0.6 of this in red, and 1.2 times in blue.
static void gold_between_paint_is_the_mean_of_its_texels(void **state) {
    static const metal_case cases[] = {
        {"toksvig", true, 1, 1, 1, false},    {"lean", true, 1, 1, 1, false},
        {"lobes", true, 1, 1, 1, false},      {"toksvig", true, 1, 0.5, 1, false},
        {"toksvig", false, 1, 0.9, 1, false}, {"toksvig", true, 1, 1, 3, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Half metal covers half of a colour: what it lets through is brighter under a dark tint.
static void a_mesh_tints_half_metal(void **state) {
    static const metal_case cases[] = {{"moments", true, 0.5, 0.4, 1, true},
                                       {"moments", false, 0.5, 0.4, 1, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_case(*state, &cases[i]);
}

/// Gold with holes; `metallic`: of what the mask cuts away.
static lobe_scene *masked_gold(float metallic) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, 1);
    add_maps(scene, &material, true, 1);
    float *colours = (float *)scene->images[material.base_colour_map.image].image.texels;
    float *widths = (float *)scene->images[material.metallic_roughness_map.image].image.texels;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const bool kept = widths[4 * i + 2] > 0;
        colours[4 * i + 3] = kept ? 1 : 0;
        widths[4 * i + 2] = kept ? 1 : metallic;
    }
    // Metal is the same everywhere in neither scene.
    widths[2] = 0.9f;
    material.alpha_mask = material.double_sided = true;
    material.alpha_cutoff = 0.5f;
    scene_add_square(scene, &material, 40, NULL);
    scene_look_down(scene, 0.2);
    scene_add_sun(scene, (double[]){0.1, 1, 0}, 1);
    scene_end(scene);
    return scene;
}

/// Near, where level 0 has a part of the picture, and from afar.
static void what_a_mask_cuts_is_no_metal(void **state) {
    static const uint32_t widths[] = {9, 60};
    for (int i = 0; i < 2; i++) {
        double sums[2][3] = {{0}};
        for (int k = 0; k < 2; k++) {
            lobe_scene *scene = masked_gold((float)k);
            const picture_request request = {.filter = "toksvig", .width = widths[i], .height = 9};
            lobe_frame frame = draw_scene(*state, scene, &request);
            for (uint32_t j = 0; j < 3 * frame.radiance.width * frame.radiance.height; j++)
                sums[k][j % 3] += (double)((const float *)frame.radiance.texels)[j / 3 * 4 + j % 3];
            lobe_frame_free(&frame);
            lobe_scene_destroy(&scene);
        }
        for (int j = 0; j < 3; j++)
            if (!(sums[1][j] > 0 && fabs(sums[0][j] / sums[1][j] - 1) < 0.01))
                fail_msg("%u pixels wide, channel %d: %g with paint in the holes, %g with metal",
                         widths[i], j, sums[0][j], sums[1][j]);
    }
}

/// The mean of colour times metal over the points of the four texels under one of level 0.
static void mean_over_points(const lobe_scene *scene, uint32_t x, uint32_t y,
                             const uint32_t size[2], double mean[3]) {
    const lobe_material *material = &scene->materials[0];
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t i = 0; i < 4 * TEXEL_POINTS; i++) {
        const double offset = 0.5 + (i % 2 == 0 ? TEXEL_POINT : -TEXEL_POINT);
        const double u = (2 * x + i / 2 % 2 + offset) / size[0];
        const double v = (2 * y + i / 4 + offset) / size[1]; // NOLINT: whole texels
        double colour[4], width[4];
        reference_map_value(scene, &material->base_colour_map, u, v, colour);
        reference_map_value(scene, &material->metallic_roughness_map, u, v, width);
        for (int j = 0; j < 3; j++)
            mean[j] += width[2] * colour[j] / (4 * TEXEL_POINTS);
    }
}

/// Colours and metal of independent texels, interpolated, at all edges.
static void check_edges(fixture *f, const uint32_t size[2], lobe_scene_wrap wrap_u,
                        lobe_scene_wrap wrap_v) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1);
    material.base_colour_map = scene_add_map(scene, random_map(size[0], size[1], 0, 1, 171));
    material.metallic_roughness_map = scene_add_map(scene, random_map(size[0], size[1], 0, 1, 172));
    lobe_texture_use *uses[] = {&material.base_colour_map, &material.metallic_roughness_map};
    for (int i = 0; i < 2; i++) {
        uses[i]->wrap_u = wrap_u;
        uses[i]->wrap_v = wrap_v;
    }
    scene_end_with_square(scene, &material);
    pass_run run;
    pass_run_begin(&run, f, scene, "lobes", (const char *[]){NULL});
    const reduced_map map = passes_metal_means(&run.context, 0);
    float *found = pass_run_read(&run, &map, LOBE_FORMAT_RGBA16_FLOAT);
    for (uint32_t i = 0; i < map.width * map.height; i++) {
        const uint32_t x = i % map.width, y = i / map.width;
        double expected[3];
        mean_over_points(scene, x, y, size, expected);
        for (uint32_t j = 0; j < 3; j++)
            if (!(fabs((double)found[4 * i + j] - expected[j]) < 0.002))
                fail_msg("%u x %u, wrap %d and %d, texel %u, %u: %g instead of %g", size[0],
                         size[1], (int)wrap_u, (int)wrap_v, x, y, (double)found[4 * i + j],
                         expected[j]);
    }
    free(found);
    pass_run_end(&run);
    lobe_scene_destroy(&scene);
}

static void interpolated_colours_wrap_as_the_sampler_says(void **state) {
    static const uint32_t sizes[][2] = {{8, 6}, {2, 4}};
    static const lobe_scene_wrap wraps[] = {LOBE_SCENE_WRAP_REPEAT, LOBE_SCENE_WRAP_MIRROR,
                                            LOBE_SCENE_WRAP_CLAMP};
    for (int i = 0; i < 9; i++)
        check_edges(*state, sizes[i % 2], wraps[i % 3], wraps[i / 3]);
    check_edges(*state, (uint32_t[]){2, 2}, LOBE_SCENE_WRAP_REPEAT, LOBE_SCENE_WRAP_CLAMP);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gold_between_paint_is_the_mean_of_its_texels),
        cmocka_unit_test(a_mesh_tints_half_metal),
        cmocka_unit_test(what_a_mask_cuts_is_no_metal),
        cmocka_unit_test(interpolated_colours_wrap_as_the_sampler_says),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
