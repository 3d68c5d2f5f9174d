// Shadows of lights, against rays that the host casts from the pixels of a plane.

#include "passes/renderer/shadows/shadow_maps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/long_runs.h"

#include "scenes/scene/scene.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 64 };
/// Across the picture, metres.
#define SEEN 6.0

static lobe_material matt(void) {
    return microfacet_material(LOBE_DISTRIBUTION_BECKMANN, 1, 0);
}

// ---------------------------------------------------------------------------------------------
// A square above a plane

/// The square: 1 m wide, 1 m above the plane, turned, off the centre.
static const float square_transform[16] = {0.4f,  0, 0.3f, 0, 0,    1, 0,     0,
                                           -0.3f, 0, 0.4f, 0, 0.2f, 1, -0.3f, 1};

static lobe_scene *sheet_scene(const lobe_light *light, const lobe_material *sheet) {
    lobe_scene *scene = scene_begin();
    const lobe_material ground = matt();
    scene_add_square(scene, &ground, 1, (float[]){5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 5, 0, 0, 0, 0, 1});
    scene_add_square(scene, sheet, 1, square_transform);
    assert_int_equal(scenes_add_lights(scene, light, 1, NULL), LOBE_OK);
    scene_look_down(scene, SEEN);
    scene_end(scene);
    return scene;
}

/// Where the plane y = 1 is crossed from a point on the ground towards the light, in the square's
/// own coordinates: inside it in [-1, 1].
static void cross(const lobe_light *light, const double ground[2], double own[2]) {
    double at[2];
    for (int i = 0; i < 2; i++) {
        const int axis = 2 * i;
        const double step =
            light->type == LOBE_LIGHT_DIRECTIONAL
                ? (double)light->direction[axis] / (double)light->direction[1]
                : ((double)light->position[axis] - ground[i]) / (double)light->position[1];
        at[i] = ground[i] + step - (double)square_transform[12 + axis];
    }
    const double a = (double)square_transform[0], b = (double)square_transform[2];
    const double square = a * a + b * b;
    own[0] = (a * at[0] + b * at[1]) / square;
    own[1] = (-b * at[0] + a * at[1]) / square;
}

/// The side of the square's shadow on which a point lies: 1 in it, -1 outside, 0 near its edge.
static int side_of_shadow(const lobe_light *light, const double ground[2], double margin) {
    double own[2];
    cross(light, ground, own);
    const double outside = fmax(fabs(own[0]), fabs(own[1])) - 1;
    return outside < -margin ? 1 : outside > margin ? -1 : 0;
}

/// Whether the camera sees the square there.
static bool is_covered(const double ground[2], double margin) {
    static const lobe_light above = {.type = LOBE_LIGHT_DIRECTIONAL, .direction = {0, -1, 0}};
    return side_of_shadow(&above, ground, margin) >= 0;
}

static picture_request request_of(const char *filter, const char *shadows) {
    return (picture_request){
        .filter = filter, .settings = {shadows}, .width = EXTENT, .height = EXTENT, .samples = 4};
}

/// Whether a point's shadow is what rays say; counts the points in it.
static void check_shadow(const lobe_frame *lit, const lobe_frame *shadowed, const lobe_light *light,
                         const double own_hole, int *inside) {
    for (uint32_t y = 0; y < EXTENT; y++) {
        for (uint32_t x = 0; x < EXTENT; x++) {
            const double pixel = SEEN / EXTENT;
            const double ground[2] = {(x + 0.5) * pixel - SEEN / 2, (y + 0.5) * pixel - SEEN / 2};
            const float *with = pixel_at(&shadowed->radiance, x, y);
            const float *without = pixel_at(&lit->radiance, x, y);
            // The square is 0.5 m from its centre to its sides.
            const double margin = 2 * pixel;
            const int side = side_of_shadow(light, ground, margin);
            double own[2];
            cross(light, ground, own);
            if (is_covered(ground, margin) || side == 0 || fabs(own[0] - own_hole) < margin)
                continue;
            const bool dark = side > 0 && own[0] > own_hole;
            assert_true(without[1] > 0 || light->type == LOBE_LIGHT_SPOT);
            if (dark)
                assert_float_equal(with[1], 0, 0);
            else
                assert_float_equal(with[1], without[1], 1e-6 * (double)without[1]);
            *inside += dark;
        }
    }
}

static const lobe_light lights[] = {
    {.type = LOBE_LIGHT_DIRECTIONAL, .direction = {0.6f, -0.64f, 0.48f}, .intensity = {3, 3, 3}},
    {.type = LOBE_LIGHT_DIRECTIONAL, .direction = {-0.8f, -0.6f, 0}, .intensity = {3, 3, 3}},
    {.type = LOBE_LIGHT_POINT, .position = {1.5f, 2.5f, -1}, .intensity = {9, 9, 9}},
    {.type = LOBE_LIGHT_POINT, .position = {0.3f, 1.6f, -0.8f}, .intensity = {9, 9, 9}},
    {.type = LOBE_LIGHT_SPOT,
     .position = {-1.2f, 3, 0.7f},
     .direction = {0.36f, -0.8f, -0.48f},
     .intensity = {9, 9, 9},
     .inner_cone = 0.6f,
     .outer_cone = 0.7f},
    {.type = LOBE_LIGHT_SPOT,
     .position = {-1.2f, 3, 0.7f},
     .direction = {0.36f, -0.8f, -0.48f},
     .intensity = {9, 9, 9},
     .inner_cone = 0.6f,
     .outer_cone = 1.5f},
};

static void each_kind_of_light_has_shadows(void **state) {
    fixture *f = *state;
    const lobe_material sheet = matt();
    static const char *const filters[] = {"mipmap", "reference"};
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        lobe_scene *scene = sheet_scene(&lights[i], &sheet);
        for (int k = 0; k < 2; k++) {
            int inside = 0;
            const picture_request bare = request_of(filters[k], NULL);
            const picture_request shadows = request_of(filters[k], "shadows=1024");
            lobe_frame lit = draw_scene(f, scene, &bare);
            lobe_frame shadowed = draw_scene(f, scene, &shadows);
            check_shadow(&lit, &shadowed, &lights[i], -INFINITY, &inside);
            assert_true(inside > 20);
            lobe_frame_free(&lit);
            lobe_frame_free(&shadowed);
        }
        lobe_scene_destroy(&scene);
    }
}

/// Light falls through the half of the square whose texels are cut away.
static void masks_let_light_through(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 3; i += 2) {
        lobe_material sheet = matt();
        lobe_scene *scene = sheet_scene(&lights[i], &sheet);
        lobe_image map = constant_map(64, 64, 1, 1, 1);
        for (int k = 0; k < 64 * 64; k++)
            ((float *)map.texels)[4 * k + 3] = k % 64 < 32 ? 0 : 1;
        scene->materials[1].base_colour_map = scene_add_map(scene, map);
        scene->materials[1].base_colour_map.wrap_u = LOBE_SCENE_WRAP_CLAMP;
        scene->materials[1].alpha_mask = true;
        scene->materials[1].alpha_cutoff = 0.5f;
        int inside = 0;
        const picture_request bare = request_of("mipmap", NULL);
        const picture_request shadows = request_of("mipmap", "shadows=1024");
        lobe_frame lit = draw_scene(f, scene, &bare);
        lobe_frame shadowed = draw_scene(f, scene, &shadows);
        check_shadow(&lit, &shadowed, &lights[i], 0, &inside);
        assert_true(inside > 20);
        lobe_frame_free(&lit);
        lobe_frame_free(&shadowed);
        lobe_scene_destroy(&scene);
    }
}

/// The edge of a shadow stays as sharp as the picture shows it: its map covers what is seen.
static void maps_follow_the_camera(void **state) {
    fixture *f = *state;
    const lobe_material sheet = matt();
    for (int perspective = 0; perspective < 2; perspective++) {
        lobe_scene *scene = sheet_scene(&lights[0], &sheet);
        // At the middle of one side of the shadow: on the ground, half of the picture is dark.
        const double side[2] = {(double)square_transform[12] - (double)square_transform[0],
                                (double)square_transform[14] - (double)square_transform[2]};
        const float at[3] = {(float)side[0] + 0.6f / 0.64f, 0, (float)side[1] + 0.48f / 0.64f};
        scene->camera = (lobe_camera){.eye = {at[0], 0.1f, at[2]},
                                      .target = {at[0], 0, at[2]},
                                      .up = {0, 0, -1},
                                      .vertical_field_of_view = perspective ? 0.2f : 0,
                                      .orthographic_height = 0.02f,
                                      .near_plane = 0.01f};
        const picture_request shadows = request_of("mipmap", "shadows=512");
        lobe_frame frame = draw_scene(f, scene, &shadows);
        int dark = 0, between = 0;
        const float full = pixel_at(&frame.radiance, 0, EXTENT / 2)[1];
        for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
            const float value = ((const float *)frame.radiance.texels)[4 * i];
            dark += value < 0.5f * full;
            between += value > 0.01f * full && value < 0.99f * full;
        }
        assert_in_range(dark, EXTENT * EXTENT * 45 / 100, EXTENT * EXTENT * 55 / 100);
        assert_in_range(between, 0, 3 * EXTENT);
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Surfaces that do not shadow themselves

/// Largest difference between pixels without background above them, where a triangle has no
/// neighbours to find its plane from.
static double difference_below_horizon(const lobe_image *lit, const lobe_image *shadowed) {
    double largest = 0;
    for (uint32_t y = 2; y < EXTENT; y++)
        for (uint32_t x = 0; x < EXTENT; x++)
            if (pixel_at(lit, x, y - 2)[3] > 0)
                largest = fmax(largest, fabs((double)pixel_at(lit, x, y)[1] -
                                             (double)pixel_at(shadowed, x, y)[1]));
    return largest;
}

/// A plane lies in its own light, however low that is and wherever the camera.
static void planes_do_not_shadow_themselves(void **state) {
    fixture *f = *state;
    static const double elevations[] = {0.5, 2, 10, 45, 89};
    for (size_t i = 0; i < sizeof elevations / sizeof *elevations; i++) {
        for (int side = 0; side < 2; side++) {
            lobe_scene *scene = scene_begin();
            const lobe_material material = matt();
            const double angle = elevations[i] * M_PI / 180;
            scene_add_square(scene, &material, 1,
                             (float[]){50, 0, 0, 0, 0, 1, 0, 0, 0, 0, 50, 0, 100, 7, 3, 1});
            scene_add_sun(
                scene, (double[]){cos(angle) * 0.6, sin(angle), (side ? 0.8 : -0.8) * cos(angle)},
                3);
            scene->camera = (lobe_camera){.eye = {100, 9, 3},
                                          .target = {side ? 130.0f : 100.3f, 7, 10},
                                          .up = {0, 1, 0},
                                          .vertical_field_of_view = 1,
                                          .near_plane = 0.01f};
            scene_end(scene);
            const picture_request bare = request_of("mipmap", NULL);
            const picture_request shadows = request_of("mipmap", "shadows=512");
            lobe_frame lit = draw_scene(f, scene, &bare);
            lobe_frame shadowed = draw_scene(f, scene, &shadows);
            assert_float_equal(difference_below_horizon(&lit.radiance, &shadowed.radiance), 0,
                               1e-5 * largest_value(&lit.radiance));
            lobe_frame_free(&lit);
            lobe_frame_free(&shadowed);
            lobe_scene_destroy(&scene);
        }
    }
}

/// The lit half of a sphere is lit, except for where the light grazes it; the other half is dark.
static void spheres_are_lit_from_one_side(void **state) {
    fixture *f = *state;
    const double towards[3] = {0.6, 0.48, 0.64};
    lobe_scene *scene = scene_begin();
    const lobe_material material = matt();
    scene_add_sphere(scene, &material, 1);
    scene_add_sun(scene, towards, 3);
    scene_look_down(scene, 2);
    scene_end(scene);
    const picture_request bare = request_of("mipmap", NULL);
    const picture_request shadows = request_of("mipmap", "shadows=512");
    lobe_frame lit = draw_scene(f, scene, &bare);
    lobe_frame shadowed = draw_scene(f, scene, &shadows);
    for (uint32_t y = 0; y < EXTENT; y++) {
        for (uint32_t x = 0; x < EXTENT; x++) {
            const double place[2] = {(x + 0.5) * 2 / EXTENT - 1, (y + 0.5) * 2 / EXTENT - 1};
            const double square = place[0] * place[0] + place[1] * place[1];
            if (square > 0.9)
                continue;
            const double cosine =
                place[0] * towards[0] + sqrt(1 - square) * towards[1] + place[1] * towards[2];
            const double with = (double)pixel_at(&shadowed.radiance, x, y)[1];
            const double without = (double)pixel_at(&lit.radiance, x, y)[1];
            if (cosine > 0.1)
                assert_float_equal(with, without, 1e-3 * without);
            else if (cosine < -0.1)
                assert_float_equal(with, 0, 1e-6);
        }
    }
    lobe_frame_free(&lit);
    lobe_frame_free(&shadowed);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Displaced surfaces

enum { GROOVES = 4, GROOVE_TEXELS = 256 };

/// Straight grooves along z, GROOVES of them to a metre, whose sides rise by 45 degrees.
static lobe_scene *groove_scene(const double towards[3]) {
    lobe_scene *scene = scene_begin();
    lobe_material material = matt();
    lobe_image heights = map_image(LOBE_FORMAT_RGBA32_FLOAT, GROOVES * GROOVE_TEXELS, 4);
    for (uint32_t i = 0; i < heights.width * heights.height; i++) {
        const double place = fmod((i % heights.width + 0.5) / GROOVE_TEXELS, 1);
        ((float *)heights.texels)[4 * i] = (float)(1 - fabs(2 * place - 1));
    }
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = 0.5f / GROOVES; // of a map that is 1 m wide
    scene_add_square(scene, &material, 4,
                     (float[]){2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
    scene_add_sun(scene, towards, 3);
    scene_look_down(scene, 0.5);
    scene_end(scene);
    return scene;
}

/// The part of what faces the light that no other groove shadows: rays against the profile.
static double lit_part(double elevation) {
    const double slope = tan(elevation), period = 1.0 / GROOVES, top = 0.5 * period;
    enum { STEPS = 4000 };
    int facing = 0, lit = 0;
    for (int i = 0; i < STEPS; i++) {
        const double x = (i + 0.5) / STEPS * period;
        const double height = top - fabs(x - 0.5 * period);
        // The light is at the right: so are the faces behind the crest, and the next crest is the
        // highest in the way.
        const bool faces = x > 0.5 * period || slope > 1;
        facing += faces;
        lit += faces && height + slope * (1.5 * period - x) >= top;
    }
    return (double)lit / facing;
}

static double mean_radiance(const lobe_image *image) {
    double sum = 0;
    for (uint32_t i = 0; i < image->width * image->height; i++)
        sum += (double)((const float *)image->texels)[4 * i + 1] / (image->width * image->height);
    return sum;
}

static void grooves_shadow_each_other(void **state) {
    fixture *f = *state;
    static const double elevations[] = {20, 35, 60};
    for (size_t i = 0; i < sizeof elevations / sizeof *elevations; i += long_runs() ? 1 : 2) {
        const double angle = elevations[i] * M_PI / 180;
        lobe_scene *scene = groove_scene((double[]){cos(angle), sin(angle), 0});
        picture_request request = {.filter = "reference",
                                   .settings = {"displacement=geometry", "shadows=1024"},
                                   .width = EXTENT,
                                   .height = EXTENT,
                                   .samples = 8};
        lobe_frame shadowed = draw_scene(f, scene, &request);
        request.settings[1] = NULL;
        lobe_frame lit = draw_scene(f, scene, &request);
        assert_float_equal(mean_radiance(&shadowed.radiance) / mean_radiance(&lit.radiance),
                           lit_part(angle), 0.015);
        lobe_frame_free(&shadowed);
        lobe_frame_free(&lit);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Rough relief, whose triangles meet everywhere

enum { WAVES = 5, WAVE_TEXELS = 128 };
/// Between the lowest and the highest place, metres.
#define WAVE_RANGE (2 * WAVES / 100.0)

/// Heights of a map that is 1 m wide, metres.
static double wave_height(double x, double z) {
    static const double waves[WAVES][3] = {
        {3, 2, 0.4}, {-4, 5, 1.9}, {7, 1, 3.1}, {6, -7, 0.2}, {1, 8, 5}};
    double sum = 0;
    for (int i = 0; i < WAVES; i++)
        sum += sin(2 * M_PI * (waves[i][0] * x + waves[i][1] * z) + waves[i][2]) / 100;
    return sum;
}

static lobe_scene *wave_scene(const double towards[3]) {
    lobe_scene *scene = scene_begin();
    lobe_material material = matt();
    lobe_image heights = map_image(LOBE_FORMAT_RGBA32_FLOAT, WAVE_TEXELS, WAVE_TEXELS);
    for (uint32_t i = 0; i < heights.width * heights.height; i++)
        ((float *)heights.texels)[4 * i] =
            (float)(0.5 + wave_height((i % WAVE_TEXELS + 0.5) / WAVE_TEXELS,
                                      (i / WAVE_TEXELS + 0.5) / WAVE_TEXELS) /
                              WAVE_RANGE);
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = (float)WAVE_RANGE;
    scene_add_square(scene, &material, 4,
                     (float[]){2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
    scene_add_sun(scene, towards, 3);
    scene_look_down(scene, 1);
    scene_end(scene);
    return scene;
}

/// The part of the light on what faces it that no other wave stops: rays over the heights.
static double light_that_arrives(const double towards[3]) {
    enum { POINTS = 96, STEPS_A_METRE = 400 };
    const double delta = 1e-5, highest = WAVES / 100.0;
    double facing = 0, arriving = 0;
    for (int i = 0; i < POINTS * POINTS; i++) {
        const double x = (i % POINTS + 0.5) / POINTS, z = (i / POINTS + 0.5) / POINTS;
        const double height = wave_height(x, z);
        const double slope[2] = {(wave_height(x + delta, z) - height) / delta,
                                 (wave_height(x, z + delta) - height) / delta};
        const double cosine = (towards[1] - slope[0] * towards[0] - slope[1] * towards[2]) /
                              sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
        if (cosine <= 0)
            continue;
        bool lit = true;
        for (int k = 1; lit; k++) {
            const double way = (double)k / STEPS_A_METRE, ray = height + way * towards[1];
            if (ray > highest)
                break;
            lit = wave_height(x + way * towards[0], z + way * towards[2]) <= ray;
        }
        facing += cosine;
        arriving += lit ? cosine : 0;
    }
    return arriving / facing;
}

/// Where triangles meet in a valley, each is nearer to the light than the other's plane: neither
/// shadows the other. So texels of twice the size do not change the mean.
static void shadows_of_rough_relief_converge(void **state) {
    fixture *f = *state;
    static const double elevations[] = {12, 30};
    for (size_t i = !long_runs(); i < sizeof elevations / sizeof *elevations; i++) {
        const double angle = elevations[i] * M_PI / 180;
        const double towards[3] = {cos(angle) * 0.8, sin(angle), cos(angle) * 0.6};
        static const char *const sizes[] = {NULL, "shadows=512", "shadows=1024"};
        lobe_scene *scene = wave_scene(towards);
        double means[3];
        for (int k = 0; k < 3; k++) {
            const picture_request request = {.filter = "reference",
                                             .settings = {"displacement=geometry", sizes[k]},
                                             .width = 2 * EXTENT,
                                             .height = 2 * EXTENT,
                                             .samples = 8};
            lobe_frame frame = draw_scene(f, scene, &request);
            means[k] = mean_radiance(&frame.radiance);
            lobe_frame_free(&frame);
        }
        assert_float_equal(means[1] / means[2], 1, 0.005);
        assert_float_equal(means[2] / means[0], light_that_arrives(towards), 0.01);
        lobe_scene_destroy(&scene);
    }
}

/// A plane of 4 m with a ridge along z that is 2 cm high, at x = 1 m.
static lobe_scene *ridge_scene(const double towards[3]) {
    lobe_scene *scene = scene_begin();
    lobe_material material = matt();
    lobe_image heights = map_image(LOBE_FORMAT_RGBA32_FLOAT, 2048, 4);
    for (uint32_t i = 0; i < heights.width * heights.height; i++)
        ((float *)heights.texels)[4 * i] = i % heights.width / 8 == 192;
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = 0.005f;
    scene_add_square(scene, &material, 1,
                     (float[]){2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
    scene_add_sun(scene, towards, 3);
    scene_end(scene);
    return scene;
}

/// What lies beside the picture throws its shadow into it.
static void what_is_not_seen_has_shadows(void **state) {
    fixture *f = *state;
    const double angle = 3 * M_PI / 180;
    for (int perspective = 0; perspective < 2; perspective++) {
        lobe_scene *scene = ridge_scene((double[]){cos(angle), sin(angle), 0});
        const float x = 0.75f; // the shadow reaches to 0.62
        scene->camera = (lobe_camera){.eye = {x, 0.1f, 0},
                                      .target = {x, 0, 0},
                                      .up = {0, 0, -1},
                                      .vertical_field_of_view = perspective ? 0.1f : 0,
                                      .orthographic_height = 0.005f,
                                      .near_plane = 0.001f};
        const picture_request request = {.filter = "mipmap",
                                         .settings = {"displacement=geometry", "shadows=512"},
                                         .width = EXTENT,
                                         .height = EXTENT};
        const picture_request lit = {.filter = "mipmap",
                                     .settings = {"displacement=geometry"},
                                     .width = EXTENT,
                                     .height = EXTENT};
        lobe_frame without = draw_scene(f, scene, &lit), with = draw_scene(f, scene, &request);
        assert_true(mean_radiance(&without.radiance) > 0.03);
        assert_float_equal(mean_radiance(&with.radiance), 0, 1e-6);
        lobe_frame_free(&without);
        lobe_frame_free(&with);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// What they cost

static void maps_are_kept_while_nothing_moves(void **state) {
    fixture *f = *state;
    const lobe_material sheet = matt();
    lobe_scene *scene = sheet_scene(&lights[2], &sheet);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const picture_request bare = request_of("mipmap", NULL);
    const picture_request shadows = request_of("mipmap", "shadows=512");
    const lobe_graph *graph = lobe_renderer_graph(f->renderer);
    lobe_frame frame = draw(f, &bare);
    lobe_frame_free(&frame);
    assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_RUN), 0);
    assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_SKIPPED), 0);
    frame = draw(f, &shadows);
    lobe_frame_free(&frame);
    assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_RUN), 6);
    frame = draw(f, &shadows);
    lobe_frame_free(&frame);
    assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_SKIPPED), 6);
    scene->instances[1].transform[13] = 0.8f;
    const uint32_t moved = 1;
    assert_int_equal(
        lobe_renderer_update_scene(f->renderer,
                                   &(lobe_scene_changes){.instances = &moved, .instance_count = 1}),
        LOBE_OK);
    frame = draw(f, &shadows);
    lobe_frame_free(&frame);
    assert_int_equal(count_passes(graph, "shadow_map", LOBE_PASS_RUN), 6);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

/// Of five suns, four have room; one line says so, once.
static void lights_without_room_cast_no_shadow(void **state) {
    fixture *f = *state;
    const lobe_material sheet = matt();
    lobe_scene *scene = sheet_scene(&lights[0], &sheet);
    for (int i = 0; i < 4; i++)
        assert_int_equal(scenes_add_lights(scene, &lights[0], 1, NULL), LOBE_OK);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    fixture_forget_messages(f);
    const picture_request shadows = request_of("mipmap", "shadows=4096");
    for (int i = 0; i < 2; i++) {
        lobe_frame frame = draw(f, &shadows);
        assert_true(all_finite(&frame.radiance));
        lobe_frame_free(&frame);
    }
    assert_int_equal(f->warnings, 1);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_light_has_shadows),
        cmocka_unit_test(masks_let_light_through),
        cmocka_unit_test(maps_follow_the_camera),
        cmocka_unit_test(planes_do_not_shadow_themselves),
        cmocka_unit_test(spheres_are_lit_from_one_side),
        cmocka_unit_test(grooves_shadow_each_other),
        cmocka_unit_test(shadows_of_rough_relief_converge),
        cmocka_unit_test(what_is_not_seen_has_shadows),
        cmocka_unit_test(maps_are_kept_while_nothing_moves),
        cmocka_unit_test(lights_without_room_cast_no_shadow),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
