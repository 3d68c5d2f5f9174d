// Diffuse colours that go with normals, through the whole renderer: of a rough field whose slopes
// to one side are red and to the other side blue, against the mean over its texels.

#include <math.h>
#include <string.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

enum { EXTENT = 128 };

typedef struct field_texel {
    double normal[3], colour[3];
} field_texel;

/// Independent slopes; `follow`: how much of the colours follows these.
static field_texel texel_at(const lobe_image *normals, uint32_t i, double follow) {
    const float *stored = (const float *)normals->texels + (size_t)4 * i;
    field_texel texel;
    double length = 0;
    for (int j = 0; j < 3; j++) {
        texel.normal[j] = 2 * (double)stored[j] - 1;
        length += texel.normal[j] * texel.normal[j];
    }
    for (int j = 0; j < 3; j++)
        texel.normal[j] /= sqrt(length);
    texel.colour[0] = 0.5 + follow * 0.7 * texel.normal[0];
    texel.colour[1] = 0.3;
    texel.colour[2] = 0.5 - follow * 0.7 * texel.normal[0];
    return texel;
}

/// `fineness`: texels of colours along each of normals.
static lobe_material lambert(lobe_scene *scene, const lobe_image *normals, double follow,
                             uint32_t fineness) {
    const uint32_t width = fineness * EXTENT;
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 10);
    lobe_image colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, width),
               copy = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    memcpy(copy.texels, normals->texels, (size_t)16 * EXTENT * EXTENT);
    for (uint32_t i = 0; i < width * width; i++) {
        const field_texel texel =
            texel_at(normals, i / width / fineness * EXTENT + i % width / fineness, follow);
        for (int j = 0; j < 4; j++)
            ((float *)colours.texels)[4 * i + j] = j < 3 ? (float)texel.colour[j] : 1;
    }
    for (int j = 0; j < 3; j++) {
        material.base_colour[j] = 1;
        material.lobes[0].colour[j] = 0;
    }
    material.normal_map = scene_add_map(scene, copy);
    material.base_colour_map = scene_add_map(scene, colours);
    material.normal_map.nearest = material.base_colour_map.nearest = true;
    return material;
}

static void check_colour(const lobe_frame *frame, const double expected[3], double bound,
                         const char *filter, double angle) {
    for (int j = 0; j < 3; j++) {
        const double found = (double)pixel_at(&frame->radiance, 0, 0)[j];
        if (!(fabs(found - expected[j]) <= bound * expected[j]))
            fail_msg("%s, %g degrees, channel %d: %.6g instead of %.6g", filter, angle, j, found,
                     expected[j]);
    }
}

static lobe_scene *field(const lobe_image *normals, double follow, uint32_t fineness) {
    lobe_scene *scene = scene_begin();
    const lobe_material material = lambert(scene, normals, follow, fineness);
    scene_add_square(scene, &material, 40, NULL);
    scene_look_from(scene, (double[]){0, 1, 0.01}, 0.2);
    return scene;
}

static void mean_of_field(const lobe_image *normals, double follow, double angle,
                          double radiance[3]) {
    for (int j = 0; j < 3; j++)
        radiance[j] = 0;
    for (uint32_t k = 0; k < EXTENT * EXTENT; k++) {
        const field_texel texel = texel_at(normals, k, follow);
        const double cosine = texel.normal[0] * sin(angle) + texel.normal[2] * cos(angle);
        for (int j = 0; j < 3; j++)
            radiance[j] += texel.colour[j] * fmax(cosine, 0) / (M_PI * EXTENT * EXTENT);
    }
}

static void shine_from(lobe_scene *scene, double angle) {
    scene->lights[0].direction[0] = (float)-sin(angle);
    scene->lights[0].direction[1] = (float)-cos(angle);
}

/// World: y is up, x along u.
static void check_suns(fixture *f, const char *filter, double follow, uint32_t fineness) {
    static const double angles[] = {-60, -30, 0, 45};
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 141);
    lobe_scene *scene = field(&normals, follow, fineness);
    scene_add_sun(scene, (double[]){0, 1, 0}, 1);
    scene_end(scene);
    for (int i = 0; i < 4; i++) {
        const double angle = angles[i] * M_PI / 180;
        const picture_request request = {.filter = filter, .width = 1, .height = 1};
        double expected[3];
        mean_of_field(&normals, follow, angle, expected);
        shine_from(scene, angle);
        lobe_frame frame = draw_scene(f, scene, &request);
        check_colour(&frame, expected, 0.02, filter, angles[i]);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
    lobe_image_free(&normals);
}

/// Least x and z of normals that a mask keeps: to one side, or all that is hardly steep.
static const double to_one_side[2] = {-0.35, 0.75}, level[2] = {-1, 0.9};

/// Of texels, a mask keeps all or nothing.
static bool is_kept(const field_texel *texel, const double least[2]) {
    return texel->normal[0] > least[0] && texel->normal[2] > least[1];
}

/// Gives the field's colours an alpha of 0.8 where they are kept, else of 0.2, and counts the
/// first.
static double mask_field(lobe_scene *scene, const lobe_image *normals, double follow,
                         const double least[2]) {
    float *colours = (float *)scene->images[scene->materials[0].base_colour_map.image].image.texels;
    double count = 0;
    for (uint32_t i = 0; i < EXTENT * EXTENT; i++) {
        const field_texel texel = texel_at(normals, i, follow);
        colours[4 * i + 3] = is_kept(&texel, least) ? 0.8f : 0.2f;
        count += is_kept(&texel, least);
    }
    scene->materials[0].alpha_mask = true;
    return count;
}

/// In pairs that lean to opposite sides, so that what is level goes with neither by chance.
static lobe_image paired_normals(void) {
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.9, 141);
    float *texels = (float *)normals.texels;
    for (size_t i = 0; i < (size_t)EXTENT * EXTENT; i += 2)
        for (size_t j = 0; j < 3; j++)
            texels[4 * (i + 1) + j] = j < 2 ? 1 - texels[4 * i + j] : texels[4 * i + j];
    return normals;
}

/// By the mean of the pixels that show the surface. Of colours that do not follow normals, the mask
/// itself chooses normals.
static void check_mask(fixture *f, const char *filter, double follow, const double least[2]) {
    enum { WIDTH = 16, PIXELS = WIDTH * WIDTH };
    static const double angles[] = {-60, 0, 60};
    const picture_request request = {.filter = filter, .width = WIDTH, .height = WIDTH};
    lobe_image normals =
        least == level ? paired_normals() : random_normal_map(EXTENT, EXTENT, 0.6, 141);
    lobe_scene *scene = field(&normals, follow, 1);
    const double kept = mask_field(scene, &normals, follow, least);
    scene_add_sun(scene, (double[]){0, 1, 0}, 1);
    scene_end(scene);
    for (int i = 0; i < 3; i++) {
        const double angle = angles[i] * M_PI / 180;
        double expected[3] = {0}, found[3] = {0}, shown = 0;
        for (uint32_t k = 0; k < EXTENT * EXTENT; k++) {
            const field_texel texel = texel_at(&normals, k, follow);
            const double cosine = texel.normal[0] * sin(angle) + texel.normal[2] * cos(angle);
            for (int j = 0; j < 3 && is_kept(&texel, least); j++)
                expected[j] += texel.colour[j] * fmax(cosine, 0) / (M_PI * kept);
        }
        shine_from(scene, angle);
        lobe_frame frame = draw_scene(f, scene, &request);
        for (uint32_t k = 0; k < PIXELS; k++) {
            const float *pixel = pixel_at(&frame.radiance, k % WIDTH, k / WIDTH);
            shown += pixel[3] > 0;
            for (int j = 0; j < 3; j++)
                found[j] += (double)pixel[j];
        }
        for (int j = 0; j < 3; j++)
            if (!(fabs(found[j] / shown - expected[j]) <= 0.04 * expected[j]))
                fail_msg("%s under a mask, %g degrees, channel %d: %.6g instead of %.6g", filter,
                         angles[i], j, found[j] / shown, expected[j]);
        lobe_frame_free(&frame);
    }
    lobe_scene_destroy(&scene);
    lobe_image_free(&normals);
}

static void assert_like_new(fixture *f, const lobe_scene *scene, const picture_request *request) {
    static const uint32_t first = 0;
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    lobe_frame changed = draw(f, request);
    hold_scene(f, scene);
    lobe_frame fresh = draw(f, request);
    for (uint32_t i = 0; i < request->width; i++)
        assert_memory_equal(pixel_at(&changed.radiance, i, 0), pixel_at(&fresh.radiance, i, 0),
                            4 * sizeof(float));
    lobe_frame_free(&changed);
    lobe_frame_free(&fresh);
}

/// A mask, and another cutoff.
static void masks_may_change(void **state) {
    const picture_request request = {.filter = "toksvig", .width = 8, .height = 1};
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 141);
    lobe_scene *scene = field(&normals, 1, 1);
    lobe_material *material = &scene->materials[0];
    mask_field(scene, &normals, 1, to_one_side);
    material->alpha_mask = false;
    scene_add_sun(scene, (double[]){0.5, 1, 0}, 1);
    scene_end(scene);
    hold_scene(*state, scene);
    lobe_frame unmasked = draw(*state, &request);
    material->alpha_mask = true;
    material->alpha_cutoff = 0.1f;
    assert_like_new(*state, scene, &request);
    material->alpha_cutoff = 0.5f;
    assert_like_new(*state, scene, &request);
    material->alpha_mask = false;
    assert_like_new(*state, scene, &request);
    lobe_frame_free(&unmasked);
    hold_scene(*state, NULL);
    lobe_scene_destroy(&scene);
    lobe_image_free(&normals);
}

static void masks_keep_colours_with_their_normals(void **state) {
    check_mask(*state, "toksvig", 1, to_one_side);
    check_mask(*state, "toksvig", 0, to_one_side);
    check_mask(*state, "toksvig", 0, level);
    check_mask(*state, "moments", -1, to_one_side);
}

/// From 60 degrees the product of means has a fifth less red on one side, and more on the other.
/// Colours may be finer than normals.
static void light_from_a_side_shows_its_colours(void **state) {
    check_suns(*state, "toksvig", 1, 1);
    check_suns(*state, "moments", 1, 1);
    check_suns(*state, "toksvig", -1, 1);
    check_suns(*state, "toksvig", 1, 4);
}

/// Under a low sun `toksvig`, which takes the cosine of the mean normal, is half as bright as the
/// mean. The colour that faces away does not become darker for that.
static void low_light_takes_nothing_that_is_missing(void **state) {
    const double angle = 83 * M_PI / 180;
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 141);
    const picture_request request = {.filter = "toksvig", .width = 1, .height = 1};
    double blue[2], expected[3];
    for (int i = 0; i < 2; i++) {
        lobe_scene *scene = field(&normals, i, 1);
        scene_add_sun(scene, (double[]){0, 1, 0}, 1);
        scene_end(scene);
        shine_from(scene, angle);
        lobe_frame frame = draw_scene(*state, scene, &request);
        blue[i] = (double)pixel_at(&frame.radiance, 0, 0)[2];
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
    mean_of_field(&normals, 1, angle, expected);
    assert_true(blue[1] > 0.97 * fmin(blue[0], expected[2]));
    lobe_image_free(&normals);
}

/// Brighter towards x. A Lambert surface of normal n has the irradiance pi (1 + 2/3 n_x).
static void shine(const double direction[3], float radiance[3]) {
    for (int j = 0; j < 3; j++)
        radiance[j] = (float)(1 + direction[0]);
}

static void skies_show_their_side(void **state) {
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 141);
    lobe_scene *scene = field(&normals, 1, 1);
    const picture_request request = {
        .filter = "toksvig", .settings = {"env_size=16"}, .width = 1, .height = 1};
    double expected[3] = {0};
    scene_surround(scene, 16, shine);
    scene_end(scene);
    for (uint32_t k = 0; k < EXTENT * EXTENT; k++) {
        const field_texel texel = texel_at(&normals, k, 1);
        // Without the light from below, see shaders/environment/irradiance.glsl.
        const double light = 1 + 2 * texel.normal[0] / 3 - (0.5 - 0.5 * texel.normal[2]);
        for (int j = 0; j < 3; j++)
            expected[j] += texel.colour[j] * light / (EXTENT * EXTENT);
    }
    lobe_frame frame = draw_scene(*state, scene, &request);
    check_colour(&frame, expected, 0.02, "toksvig", 0);
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    lobe_image_free(&normals);
}

static bool makes_map(fixture *f, const lobe_scene *scene) {
    static const uint32_t first = 0;
    const picture_request request = {.filter = "toksvig", .width = 1, .height = 1};
    const lobe_scene_changes changes = {.materials = &first, .material_count = 1};
    bool made = false;
    if (scene)
        hold_scene(f, scene);
    else
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
    lobe_frame frame = draw(f, &request);
    for (size_t i = 0; i < frame.pass_count; i++)
        made = made || strcmp(frame.passes[i].name, "colour_normals") == 0;
    lobe_frame_free(&frame);
    return made;
}

static lobe_scene *lit_field(const lobe_image *normals, double follow) {
    lobe_scene *scene = field(normals, follow, 1);
    scene_add_sun(scene, (double[]){0, 1, 0}, 1);
    scene_end(scene);
    return scene;
}

/// Nor those that lie elsewhere, nor those of normals that have become flat.
static void colours_that_do_not_follow_need_no_map(void **state) {
    lobe_image normals = random_normal_map(EXTENT, EXTENT, 0.6, 141);
    lobe_scene *following = lit_field(&normals, 1), *other = lit_field(&normals, 0.01);
    lobe_material *material = &following->materials[0];
    assert_false(makes_map(*state, other));
    assert_true(makes_map(*state, following));
    material->base_colour_map.transform[0][0] = 2;
    assert_false(makes_map(*state, NULL));
    material->base_colour_map.transform[0][0] = 1;
    assert_true(makes_map(*state, NULL));
    material->normal_scale = 0.01f;
    assert_false(makes_map(*state, NULL));
    hold_scene(*state, NULL);
    lobe_scene_destroy(&following);
    lobe_scene_destroy(&other);
    lobe_image_free(&normals);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_from_a_side_shows_its_colours),
        cmocka_unit_test(masks_keep_colours_with_their_normals),
        cmocka_unit_test(masks_may_change),
        cmocka_unit_test(low_light_takes_nothing_that_is_missing),
        cmocka_unit_test(skies_show_their_side),
        cmocka_unit_test(colours_that_do_not_follow_need_no_map),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
