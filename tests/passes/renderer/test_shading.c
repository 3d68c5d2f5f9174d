// The shading pass against double precision: the base material under every kind of light, mixtures
// of lobes by Algorithm 1, and which MIP level a pixel reads.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "scenes/scene/scene.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/light/light.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/map/normal_map.h"
#include "tests/reference/vector.h"

/// From the world to the tangent frame of scene_add_square, and to unit length.
static void to_tangent(const double world[3], double tangent[3]) {
    const double turned[3] = {world[0], -world[2], world[1]};
    memcpy(tangent, turned, sizeof turned);
    reference_normalise(tangent);
}

/// Radiance of a point under a scene's lights, with the reflectance given by `shade`.
typedef void (*shade_function)(const void *user, const double outgoing[3], const double incoming[3],
                               double radiance[3]);

/// Irradiance perpendicular to the light's direction, and that direction.
static double irradiance_of(const lobe_light *light, const double position[3], double towards[3]) {
    double direction[3], distance = 1;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)light->direction[i];
        towards[i] = light->type == LOBE_LIGHT_DIRECTIONAL
                         ? -direction[i]
                         : (double)light->position[i] - position[i];
    }
    if (light->type == LOBE_LIGHT_DIRECTIONAL)
        return 1;
    distance = reference_length(towards);
    reference_normalise(towards);
    double attenuation = reference_distance_attenuation(distance, (double)light->range);
    if (light->type == LOBE_LIGHT_SPOT)
        attenuation *=
            reference_cone_attenuation(-reference_dot(towards, direction),
                                       (double)light->inner_cone, (double)light->outer_cone);
    return attenuation;
}

static void light_point(const lobe_scene *scene, const double position[3], const double eye[3],
                        shade_function shade, const void *user, double sum[3]) {
    double outgoing[3], incoming[3], towards[3], radiance[3];
    to_tangent(eye, outgoing);
    sum[0] = sum[1] = sum[2] = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        double irradiance = irradiance_of(&scene->lights[i], position, towards);
        to_tangent(towards, incoming);
        shade(user, outgoing, incoming, radiance);
        for (int j = 0; j < 3; j++)
            sum[j] += radiance[j] * irradiance * (double)scene->lights[i].intensity[j];
    }
}

static void check_pixel(const lobe_frame *frame, uint32_t x, uint32_t y, const double expected[3],
                        double tolerance, const char *what) {
    const float *pixel = pixel_at(&frame->radiance, x, y);
    for (int i = 0; i < 3; i++) {
        if (!(fabs((double)pixel[i] - expected[i]) <= tolerance * fabs(expected[i]) + 1e-6))
            fail_msg("%s, pixel %u, %u, channel %d: %.7g instead of %.7g", what, x, y, i,
                     (double)pixel[i], expected[i]);
    }
    assert_true(pixel[3] == 1);
}

// ---------------------------------------------------------------------------------------------
// The base material

typedef struct base_point {
    const lobe_material *material;
    double normal[3];
} base_point;

static void shade_base(const void *user, const double outgoing[3], const double incoming[3],
                       double radiance[3]) {
    const base_point *point = user;
    shade_base_material(point->material, point->normal, outgoing, incoming, radiance);
}

/// One of each kind, of different colours.
static void add_lights_of_all_kinds(lobe_scene *scene) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_SPOT,
         .position = {0.5f, 1.5f, 0.25f},
         .direction = {-0.36f, -0.8f, 0.48f},
         .intensity = {2, 3, 1},
         .inner_cone = 0.2f,
         .outer_cone = 0.9f},
        {.type = LOBE_LIGHT_POINT,
         .position = {-0.5f, 1.25f, 0.75f},
         .intensity = {1, 2, 4},
         .range = 2.5f},
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.48f, -0.8f, 0.36f},
         .intensity = {1, 2, 3}},
        {.type = LOBE_LIGHT_POINT, .position = {0.25f, 2, -0.5f}, .intensity = {3, 1, 2}},
    };
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
        assert_int_equal(scenes_add_light(scene, &lights[i], NULL), LOBE_OK);
}

static lobe_material material_of(lobe_material_model model, lobe_distribution distribution) {
    lobe_material material = half_vector_material(distribution, 40);
    if (model == LOBE_MATERIAL_MICROFACET) {
        lobe_material_default(&material);
        material.distribution = distribution;
        material.roughness = 0.6f;
        material.metallic = 0.25f;
    } else {
        material.lobe_count = 2;
        material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 40, {0.5f, 0.25f, 0.125f}};
        material.lobes[1] = (lobe_base_lobe){{0, -0.28f, 0.96f}, 15, {0.1f, 0.2f, 0.3f}};
    }
    material.base_colour[0] = 0.8f;
    material.base_colour[1] = 0.5f;
    material.base_colour[2] = 0.25f;
    return material;
}

/// Pixel centres coincide with texel centres, so normals are used unchanged. Some directions are
/// below the texel's own horizon.
static void check_base_material(fixture *f, lobe_material material, const char *what) {
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, random_normal_map(4, 4, 0.9, 31));
    scene_add_square(scene, &material, 1, NULL);
    add_lights_of_all_kinds(scene);
    scene_look_down(scene, 2);
    scene_end(scene);
    lobe_frame frame = draw_scene(
        f, scene,
        &(picture_request){.filter = "direct", .settings = {NULL}, .width = 4, .height = 4});
    for (uint32_t i = 0; i < 16; i++) {
        uint32_t x = i % 4, y = i / 4;
        double texel[4], expected[3];
        const double position[3] = {0.5 * x - 0.75, 0, 0.5 * y - 0.75}, up[3] = {0, 1, 0};
        base_point point = {.material = &material};
        reference_image_texel(&scene->images[0].image, x, y, texel);
        reference_decode_normal(texel, 1, point.normal);
        light_point(scene, position, up, shade_base, &point, expected);
        check_pixel(&frame, x, y, expected, 2e-4, what);
    }
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void base_materials_reflect_all_kinds_of_light(void **state) {
    static const char *const names[] = {"GGX", "Beckmann", "Blinn-Phong", "vMF"};
    for (int i = 0; i < 4; i++)
        check_base_material(*state, material_of(LOBE_MATERIAL_MICROFACET, (lobe_distribution)i),
                            names[i]);
    check_base_material(*state,
                        material_of(LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_BLINN_PHONG),
                        "Blinn-Phong lobes");
    lobe_material material = material_of(LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_VMF);
    check_base_material(*state, material, "vMF lobes");
    material.normal_concentration = 30;
    check_base_material(*state, material, "convolved vMF lobes");
    material = material_of(LOBE_MATERIAL_MICROFACET, LOBE_DISTRIBUTION_GGX);
    material.normal_concentration = 30;
    check_base_material(*state, material, "convolved GGX");
}

/// Where the ray of a pixel's centre meets the plane y = 0, and the way back to the eye.
static void hit_ground(const lobe_camera *camera, uint32_t x, uint32_t y, uint32_t width,
                       uint32_t height, double position[3], double towards_eye[3]) {
    double forward[3], up[3], right[3];
    for (int i = 0; i < 3; i++) {
        forward[i] = (double)camera->target[i] - (double)camera->eye[i];
        up[i] = (double)camera->up[i];
    }
    reference_normalise(forward);
    for (int i = 0; i < 3; i++)
        right[i] = forward[(i + 1) % 3] * up[(i + 2) % 3] - forward[(i + 2) % 3] * up[(i + 1) % 3];
    reference_normalise(right);
    for (int i = 0; i < 3; i++)
        up[i] =
            right[(i + 1) % 3] * forward[(i + 2) % 3] - right[(i + 2) % 3] * forward[(i + 1) % 3];
    bool perspective = camera->vertical_field_of_view > 0;
    double half_height = perspective ? tan(0.5 * (double)camera->vertical_field_of_view)
                                     : 0.5 * (double)camera->orthographic_height;
    double across = (2 * (x + 0.5) / width - 1) * half_height * width / height;
    double upwards = (1 - 2 * (y + 0.5) / height) * half_height;
    double origin[3], direction[3];
    for (int i = 0; i < 3; i++) {
        double offset = across * right[i] + upwards * up[i];
        origin[i] = (double)camera->eye[i] + (perspective ? 0 : offset);
        direction[i] = forward[i] + (perspective ? offset : 0);
    }
    double distance = -origin[1] / direction[1];
    for (int i = 0; i < 3; i++) {
        position[i] = origin[i] + distance * direction[i];
        towards_eye[i] = -direction[i];
    }
}

/// Any camera: the point that a pixel sees, its depth along the view axis, and the directions
/// there.
static void cameras_see_what_they_should(void **state) {
    for (int perspective = 0; perspective < 2; perspective++) {
        enum { WIDTH = 12, HEIGHT = 8 };
        lobe_scene *scene = scene_begin();
        lobe_material material = material_of(LOBE_MATERIAL_MICROFACET, LOBE_DISTRIBUTION_GGX);
        base_point point = {.material = &material, .normal = {0.36, -0.48, 0.8}};
        material.normal_map = scene_add_map(scene, constant_map(1, 1, 0.68f, 0.26f, 0.9f));
        scene_add_square(scene, &material, 1, NULL);
        add_lights_of_all_kinds(scene);
        scene_end(scene);
        scene->camera = (lobe_camera){.eye = {0.5f, 1.5f, 1},
                                      .target = {0.1f, 0, -0.1f},
                                      .up = {0, 1, 0},
                                      .vertical_field_of_view = perspective ? 0.4f : 0,
                                      .orthographic_height = 0.8f,
                                      .near_plane = 0.1f};
        scene->has_camera = true;
        lobe_frame frame = draw_scene(*state, scene,
                                      &(picture_request){.filter = "direct",
                                                         .settings = {NULL},
                                                         .width = WIDTH,
                                                         .height = HEIGHT,
                                                         .outputs = true});
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            uint32_t x = i % WIDTH, y = i / WIDTH;
            double position[3], towards_eye[3], expected[3], axis[3], depth = 0;
            hit_ground(&scene->camera, x, y, WIDTH, HEIGHT, position, towards_eye);
            light_point(scene, position, towards_eye, shade_base, &point, expected);
            check_pixel(&frame, x, y, expected, 5e-4, perspective ? "perspective" : "orthographic");
            for (int j = 0; j < 3; j++)
                axis[j] = (double)scene->camera.target[j] - (double)scene->camera.eye[j];
            reference_normalise(axis);
            for (int j = 0; j < 3; j++)
                depth += axis[j] * (position[j] - (double)scene->camera.eye[j]);
            const float *output = pixel_at(&frame.normal_depth, x, y);
            const double world_normal[3] = {0.36, 0.8, 0.48};
            for (int j = 0; j < 3; j++)
                assert_true(fabs((double)output[j] - world_normal[j]) < 1e-5);
            assert_true(fabs((double)output[3] - depth) < 1e-4);
        }
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
}

static void sky(const double direction[3], float radiance[3]) {
    for (int i = 0; i < 3; i++)
        radiance[i] = (float)(0.5 + 0.4 * direction[i]);
}

static lobe_scene *square_below_sky(bool perspective) {
    lobe_scene *scene = scene_begin();
    lobe_material material = material_of(LOBE_MATERIAL_MICROFACET, LOBE_DISTRIBUTION_GGX);
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.5, 191));
    scene_add_square(scene, &material, 2, NULL);
    scene_surround(scene, 32, sky);
    scene->environment_visible = true;
    scene_end(scene);
    scene->camera = (lobe_camera){.eye = {0.5f, 0.7f, 1.6f},
                                  .target = {0.1f, 0.2f, -0.1f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = perspective ? 1 : 0,
                                  .orthographic_height = 1.5f,
                                  .near_plane = 0.1f};
    scene->has_camera = true;
    return scene;
}

/// The picture's quarters, each drawn by a camera of half the height.
static void shifted_cameras_draw_tiles(void **state) {
    enum { WIDTH = 24, HEIGHT = 16 };
    for (int perspective = 0; perspective < 2; perspective++) {
        lobe_scene *scene = square_below_sky(perspective);
        picture_request request = {.filter = "moments",
                                   .settings = {"env=sampled", "env_size=16"},
                                   .width = WIDTH,
                                   .height = HEIGHT};
        lobe_frame whole = draw_scene(*state, scene, &request);
        lobe_camera *camera = &scene->camera;
        if (perspective)
            camera->vertical_field_of_view =
                2 * atanf(0.5f * tanf(0.5f * camera->vertical_field_of_view));
        camera->orthographic_height *= 0.5f;
        request.width = WIDTH / 2;
        request.height = HEIGHT / 2;
        for (uint32_t tile = 0; tile < 4; tile++) {
            const uint32_t left = tile % 2 * request.width, top = tile / 2 * request.height;
            camera->shift[0] = (tile % 2 ? 0.5f : -0.5f) * WIDTH / HEIGHT;
            camera->shift[1] = tile / 2 ? 0.5f : -0.5f;
            lobe_frame frame = draw_scene(*state, scene, &request);
            for (uint32_t i = 0; i < request.width * request.height; i++) {
                const uint32_t x = i % request.width, y = i / request.width;
                const float *found = pixel_at(&frame.radiance, x, y),
                            *expected = pixel_at(&whole.radiance, left + x, top + y);
                for (int channel = 0; channel < 3; channel++)
                    assert_float_equal(found[channel], expected[channel], 1e-3);
            }
            lobe_frame_free(&frame);
        }
        lobe_frame_free(&whole);
        lobe_scene_destroy(&scene);
    }
}

/// More lights than fit in the smallest of buffers.
static void many_lights_add_up(void **state) {
    enum { COUNT = 3000 };
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 1);
    material.lobes[0].colour[0] = material.lobes[0].colour[1] = material.lobes[0].colour[2] = 0;
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 1;
    scene_add_square(scene, &material, 1, NULL);
    for (int i = 0; i < COUNT; i++)
        scene_add_sun(scene, (double[]){0, 1, 0}, M_PI / COUNT);
    scene_look_down(scene, 2);
    scene_end(scene);
    lobe_frame frame = draw_scene(
        *state, scene,
        &(picture_request){.filter = "direct", .settings = {NULL}, .width = 2, .height = 2});
    check_pixel(&frame, 1, 1, (double[]){1, 1, 1}, 1e-4, "many lights");
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Mixtures

typedef struct mixture_point {
    const lobe_material *material;
    const refinement_knobs *knobs;
    const reference_layers *mixture;
    uint32_t x, y;
    unsigned *count;
} mixture_point;

static void shade_mixture_point(const void *user, const double outgoing[3],
                                const double incoming[3], double radiance[3]) {
    const mixture_point *point = user;
    shade_mixture(point->material, point->knobs, point->mixture, point->x, point->y, outgoing,
                  incoming, radiance, point->count);
}

/// A picture of 4x4 pixels of a map of 16x16 texels: level 2 exactly, at its texels' centres.
/// `settings` are the same as `knobs`, without the subdivision.
static void check_mixture(fixture *f, lobe_material material, const char *const settings[5],
                          const refinement_knobs *knobs, const char *what) {
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 33));
    scene_add_square(scene, &material, 1, NULL);
    add_lights_of_all_kinds(scene);
    scene_look_down(scene, 2);
    scene_end(scene);
    static const char *const subdivisions[] = {"subdivision=0", "subdivision=1", "subdivision=2"};
    picture_request request = {.filter = "lobes",
                               .settings = {subdivisions[knobs->subdivision], "bias=0"},
                               .width = 4,
                               .height = 4,
                               .outputs = true};
    memcpy(request.settings + 2, settings, 5 * sizeof *settings);
    lobe_frame frame = draw_scene(f, scene, &request);
    reference_layers texels = mixture_of_texels(scene, &material, NULL, NULL);
    reference_layers half = reference_reduce(&texels), quarter = reference_reduce(&half);
    for (uint32_t i = 0; i < 16; i++) {
        uint32_t x = i % 4, y = i / 4;
        unsigned count;
        const double position[3] = {0.5 * x - 0.75, 0, 0.5 * y - 0.75}, up[3] = {0, 1, 0};
        mixture_point point = {&material, knobs, &quarter, x, y, &count};
        double expected[3];
        light_point(scene, position, up, shade_mixture_point, &point, expected);
        check_pixel(&frame, x, y, expected, 1e-3 + fixture_sampler_error(f), what);
        const float *output = pixel_at(&frame.lobes_level, x, y);
        // Where a texel of a sampler that rounds is at the limit, one lobe more or less.
        if (fabs((double)output[0] - count) > (fixture_sampler_error(f) > 0) ||
            fabs((double)output[1] - 2) > 1e-4)
            fail_msg("%s: %g lobes of level %g instead of %u of 2", what, (double)output[0],
                     (double)output[1], count);
    }
    reference_layers_free(&texels);
    reference_layers_free(&half);
    reference_layers_free(&quarter);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

typedef struct refinement_case {
    const char *name;
    const char *settings[5];
    refinement_knobs knobs;
} refinement_case;

static void lobes_are_refined_by_algorithm_1(void **state) {
    static const refinement_case cases[] = {
        {"defaults", {NULL}, {2, true, 0.95, 0.85, 0.02}},
        {"by length", {"threshold=length", NULL}, {2, false, 0.95, 0.85, 0.02}},
        {"one lobe", {"threshold=length", NULL}, {0, false, 0.95, 0.85, 0.02}},
        {"four at most", {"threshold=length", NULL}, {1, false, 0.95, 0.85, 0.02}},
        {"always eight",
         {"threshold=length", "epsilon0=1", "epsilon1=1", "blend=0", NULL},
         {2, false, 1, 1, 0}},
        {"always four",
         {"threshold=length", "epsilon0=1", "epsilon1=0", "blend=0", NULL},
         {2, false, 1, 0, 0}},
        {"never", {"threshold=length", "epsilon0=0", "blend=0", NULL}, {2, false, 0, 0.85, 0}},
        {"in between",
         {"threshold=length", "epsilon0=0.9", "blend=0.4", NULL},
         {2, false, 0.9, 0.85, 0.4}},
        {"by dispersion",
         {"epsilon0=0.3", "epsilon1=0.4", "blend=0.2", NULL},
         {2, true, 0.3, 0.4, 0.2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const refinement_case *c = &cases[i];
        lobe_material lobes = material_of(LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_VMF);
        for (int j = 0; j < 3; j++)
            lobes.lobes[1].colour[j] = lobes.lobes[0].colour[j];
        check_mixture(*state, lobes, c->settings, &c->knobs, c->name);
        lobe_material microfacets = material_of(LOBE_MATERIAL_MICROFACET, LOBE_DISTRIBUTION_GGX);
        check_mixture(*state, microfacets, c->settings, &c->knobs, c->name);
    }
}

/// Microfacets of any distribution keep its shape as far as the normals allow.
static void microfacets_keep_their_shape(void **state) {
    static const char *const names[] = {"GGX", "Beckmann", "Blinn-Phong", "vMF"};
    const char *const settings[5] = {"threshold=length", NULL};
    refinement_knobs knobs = {2, false, 0.95, 0.85, 0.02};
    for (int i = 0; i < 4; i++) {
        lobe_material material = material_of(LOBE_MATERIAL_MICROFACET, (lobe_distribution)i);
        material.roughness = 0.4f;
        check_mixture(*state, material, settings, &knobs, names[i]);
        material.normal_concentration = 80;
        check_mixture(*state, material, settings, &knobs, names[i]);
    }
}

/// Without a mean layer (all lobes equal, along their normals) the result is the same.
static void one_lobe_along_the_normal_needs_no_mean(void **state) {
    const char *const settings[5] = {"epsilon0=0.5", NULL};
    refinement_knobs knobs = {2, true, 0.5, 0.85, 0.02};
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 60);
    material.base_colour[0] = material.base_colour[1] = material.base_colour[2] = 0.5f;
    check_mixture(*state, material, settings, &knobs, "Blinn-Phong");
    material.normal_concentration = 100;
    check_mixture(*state, material, settings, &knobs, "convolved Blinn-Phong");
}

// ---------------------------------------------------------------------------------------------
// Averaged parameters

/// The one-lobe material that the naive filter's averaged parameters describe.
static lobe_material averaged_material(const lobe_material *material, double width) {
    lobe_material result = *material;
    // alpha is the square of roughness; s = kappa - 1 = 2 / alpha^2 - 2, otherwise kappa = 2 /
    // alpha^2.
    bool blinn_phong = material->distribution == LOBE_DISTRIBUTION_BLINN_PHONG;
    result.roughness = (float)pow(2 / (blinn_phong ? width + 1 : width), 0.25);
    result.normal_concentration = 0;
    for (uint32_t i = 0; i < material->lobe_count; i++)
        result.lobes[i].width *= (float)width;
    return result;
}

/// As check_mixture, with varying widths.
static void check_averages(fixture *f, lobe_material material, const char *what) {
    lobe_scene *scene = scene_begin();
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 34));
    lobe_texture_use widths = scene_add_map(scene, random_map(16, 16, 0.5, 1, 35));
    bool microfacet = material.model == LOBE_MATERIAL_MICROFACET;
    *(microfacet ? &material.metallic_roughness_map : &material.width_map) = widths;
    material.metallic = 0;
    scene_add_square(scene, &material, 1, NULL);
    add_lights_of_all_kinds(scene);
    scene_look_down(scene, 2);
    scene_end(scene);
    picture_request request = {.filter = "mipmap", .settings = {NULL}, .width = 4, .height = 4};
    lobe_frame frame = draw_scene(f, scene, &request);
    reference_layers texels = averaged_parameters_of_texels(scene, &material);
    reference_layers half = reference_reduce(&texels), quarter = reference_reduce(&half);
    for (uint32_t i = 0; i < 16; i++) {
        uint32_t x = i % 4, y = i / 4;
        const double *mean = reference_texel(&quarter, x, y, 0);
        const double position[3] = {0.5 * x - 0.75, 0, 0.5 * y - 0.75}, up[3] = {0, 1, 0};
        lobe_material averaged = averaged_material(&material, mean[3]);
        base_point point = {&averaged, {mean[0], mean[1], mean[2]}};
        double expected[3];
        reference_normalise(point.normal);
        light_point(scene, position, up, shade_base, &point, expected);
        check_pixel(&frame, x, y, expected, 1e-3 + fixture_sampler_error(f), what);
    }
    reference_layers_free(&texels);
    reference_layers_free(&half);
    reference_layers_free(&quarter);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

static void averages_are_taken_for_one_texel(void **state) {
    static const char *const names[] = {"averaged GGX", "averaged Beckmann", "averaged Blinn-Phong",
                                        "averaged vMF"};
    for (int i = 0; i < 4; i++)
        check_averages(*state, material_of(LOBE_MATERIAL_MICROFACET, (lobe_distribution)i),
                       names[i]);
    check_averages(*state, material_of(LOBE_MATERIAL_HALF_VECTOR_LOBES, LOBE_DISTRIBUTION_VMF),
                   "averaged vMF lobes");
}

// ---------------------------------------------------------------------------------------------
// Footprints

/// The level at the middle of a square with a map of 64x32 texels, in a picture of 16x16 pixels
/// that shows `height` metres of it.
static double level_of_view(fixture *f, const char *filter, double height, double tiles,
                            const char *knob, bool by_view) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 100);
    material.normal_map = scene_add_map(scene, random_normal_map(64, 32, 0.4, 41));
    // The second row turns the map's v by half a scale.
    material.normal_map.transform[0][0] = 2;
    material.normal_map.transform[0][2] = 0.3f;
    scene_add_square(scene, &material, tiles, NULL);
    scene_look_down(scene, height);
    scene_end(scene);
    picture_request request = {.filter = filter,
                               .settings = {"bias=0", knob, by_view ? "view=level" : NULL, NULL},
                               .width = 16,
                               .height = 16,
                               .outputs = !by_view};
    lobe_frame frame = draw_scene(f, scene, &request);
    double level = by_view ? (double)pixel_at(&frame.radiance, 8, 8)[0]
                           : (double)pixel_at(&frame.lobes_level, 8, 8)[1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return level;
}

/// A pixel is height/16 metres, a metre tiles/2 repetitions, a repetition 128 (64 texels, twice)
/// by 32 texels: the longer axis counts, shared by the probes, but not less than the shorter.
static void the_level_is_that_of_the_footprint(void **state) {
    static const struct {
        double height, tiles;
        const char *knob;
        double level;
    } cases[] = {
        {2, 1, "probes=1", 3},
        {2, 1, "probes=2", 2},
        {2, 1, "probes=16", 1},
        {1, 1, "probes=1", 2},
        {2, 3, "probes=1", 3 + 1.5849625},
        {2, 1, "bias=1.5", 4.5},
        {2, 1, "bias=-2", 1},
        {0.125, 1, "probes=1", 0},
        {0.125, 1, "bias=0.5", 0},
        {0.5, 1, "bias=0.25", 1.25},
    };
    static const char *const filters[] = {"lobes", "mipmap"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int j = 0; j < 4; j++) {
            double level = level_of_view(*state, filters[j % 2], cases[i].height, cases[i].tiles,
                                         cases[i].knob, j >= 2);
            if (!(fabs(level - cases[i].level) < 2e-3))
                fail_msg("%s, %g m, %g tiles, %s: level %g instead of %g", filters[j % 2],
                         cases[i].height, cases[i].tiles, cases[i].knob, level, cases[i].level);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(base_materials_reflect_all_kinds_of_light),
        cmocka_unit_test(cameras_see_what_they_should),
        cmocka_unit_test(shifted_cameras_draw_tiles),
        cmocka_unit_test(many_lights_add_up),
        cmocka_unit_test(lobes_are_refined_by_algorithm_1),
        cmocka_unit_test(microfacets_keep_their_shape),
        cmocka_unit_test(one_lobe_along_the_normal_needs_no_mean),
        cmocka_unit_test(averages_are_taken_for_one_texel),
        cmocka_unit_test(the_level_is_that_of_the_footprint),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
