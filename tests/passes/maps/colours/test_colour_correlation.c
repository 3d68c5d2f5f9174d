// Whether the device finds that colours go with normals, against sums over all texels in double
// precision; and that pictures follow what it finds, in the very frame in which texels change,
// whether the host uploads them or a pass writes them.

#include <math.h>
#include <string.h>

#include "passes/maps/colours/colour_correlation.h"
#include "shaders/interface/colours/colour_correlation.h"
#include "shaders/interface/material.h"
#include "tests/passes/maps/colours/colour_scene.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/picture.h"

enum { PATCHES = 8 };

static const colour_way ways[] = {
    {"random", 128, 128, 0, 1, -1, 0, 0},
    {"slight", 128, 128, 0.05, 1, -1, 0, 0},
    {"clear", 128, 128, 0.7, 1, -1, 0, 0},
    {"opposite", 128, 96, -0.7, 1, -1, 0, 0},
    {"half", 96, 128, 1, 0.5, -1, 0, 0},
    {"one row", 256, 1, 0.7, 1, -1, 0, 0},
    {"one column", 1, 256, 0.7, 1, -1, 0, 0},
    {"random row", 301, 1, 0, 1, -1, 0, 0},
    {"one side", 128, 128, 2.6, 1, 0.1, 0, 0},
    {"one side, less alpha", 128, 128, 2.6, 1, 0.1, 0, 0.8},
    {"another side", 128, 128, 0.25, 1, 0.3, 0, 0},
    {"cut away", 128, 128, 0.7, 1, 2, 0, 0},
    {"some metal", 128, 128, 0.7, 1, -1, 0.5, 0},
    {"metal", 128, 128, 0.7, 1, -1, 1, 0},
};
enum { WAYS = sizeof ways / sizeof *ways };

// ---------------------------------------------------------------------------------------------
// What is found

typedef struct texel_sums {
    double count, normal[2], colour[3], products[2][3];
} texel_sums;

static void add_texel(const colour_way *by, const lobe_scene *scene, size_t i, texel_sums *sums) {
    const lobe_image *colours = &scene->images[COLOUR_SCENE_COLOURS].image;
    const float *colour = (const float *)colours->texels + 4 * i;
    double normal[2];
    if (!colour_scene_keeps(by, colours, i))
        return;
    colour_scene_normal(&scene->images[COLOUR_SCENE_NORMALS].image, i, normal);
    sums->count++;
    for (int k = 0; k < 3; k++) {
        const double own = (1 - by->metallic) * (double)colour[k];
        sums->colour[k] += own;
        for (int j = 0; j < 2; j++)
            sums->products[j][k] += own * normal[j];
    }
    for (int j = 0; j < 2; j++)
        sums->normal[j] += normal[j];
}

/// The root mean square over patches of the covariance, over the mean colour.
static double covariance_of(const colour_way *by, const lobe_scene *scene) {
    texel_sums sums[PATCHES * PATCHES] = {{0}};
    double square = 0, colour = 0, count = 0;
    for (uint32_t y = 0; y < by->height; y++)
        for (uint32_t x = 0; x < by->width; x++)
            add_texel(by, scene, (size_t)y * by->width + x,
                      &sums[y * PATCHES / by->height * PATCHES + x * PATCHES / by->width]);
    for (int p = 0; p < PATCHES * PATCHES; p++) {
        const texel_sums *own = &sums[p];
        count += own->count;
        for (int k = 0; own->count > 0 && k < 3; k++) {
            colour += own->colour[k];
            for (int j = 0; j < 2; j++) {
                const double covariance = own->products[j][k] / own->count -
                                          own->normal[j] / own->count * own->colour[k] / own->count;
                square += covariance * covariance;
            }
        }
    }
    colour /= fmax(count, 1);
    return colour > 0 ? sqrt(3 * square / (PATCHES * PATCHES)) / colour : 0;
}

static struct colour_correlation_found find(fixture *f, const lobe_scene *scene) {
    lobe_resource resources[8] = {{0}};
    struct colour_correlation_found found;
    pass_run run;
    pass_run_begin(&run, f, scene, "toksvig", (const char *[]){NULL});
    filtered_images images = passes_filtered_images_of(resources, scene);
    run.context.images = &images;
    assert_true(passes_colours_may_follow_normals(&run.context, 0));
    const lobe_resource buffer = passes_colour_correlation(&run.context, 0);
    lobe_graph_read_back(f->graph, buffer, (lobe_range){0});
    pass_run_execute(&run);
    memcpy(&found, lobe_graph_data(f->graph, buffer, NULL), sizeof found);
    assert_true(passes_colours_may_follow_normals(&run.context, 0) == (found.follow != 0));
    pass_run_end(&run);
    return found;
}

/// A map is made by as many groups as its texels need, or by none.
static void check_groups(const colour_way *by, const struct colour_correlation_found *found) {
    for (uint32_t level = 0; level < COLOUR_CORRELATION_LEVELS; level++) {
        const uint32_t extents[2] = {by->width / 2 >> level, by->height / 2 >> level};
        for (int j = 0; j < 2; j++) {
            const uint32_t expected = extents[j] > 0 ? (extents[j] + 7) / 8 : 1;
            assert_int_equal(found->groups[level][j], found->follow ? expected : 0);
        }
        const uint32_t layers = level > 0 ? COLOUR_NORMALS_LAYERS : 1;
        assert_int_equal(found->groups[level][2], found->follow ? layers : 0);
    }
}

/// None of the ways is near the limit of 0.04. What sums over few texels have by chance is left
/// out.
static void colours_follow_where_they_vary_with_normals(void **state) {
    for (int i = 0; i < WAYS; i++) {
        lobe_scene *scene = colour_scene(&ways[i]);
        const double covariance = covariance_of(&ways[i], scene);
        const struct colour_correlation_found found = find(*state, scene);
        const bool few = ways[i].width * ways[i].height < 512 && ways[i].follow == 0;
        if ((few ? found.follow != 0 : found.follow != (covariance > 0.04)))
            fail_msg("%s: %u, of a covariance of %g", ways[i].name, found.follow, covariance);
        if (!few && !(covariance < 0.025 || covariance > 0.055))
            fail_msg("%s: a covariance of %g tells nothing", ways[i].name, covariance);
        check_groups(&ways[i], &found);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Pictures

static const picture_request request = {.filter = "toksvig", .width = 4, .height = 4};

static uint64_t picture(fixture *f) {
    lobe_frame frame = draw(f, &request);
    const uint64_t hash = image_hash(&frame.radiance);
    assert_true(largest_value(&frame.radiance) > 0.01);
    lobe_frame_free(&frame);
    return hash;
}

/// Of a renderer that never saw other texels.
static uint64_t fresh_picture(fixture *f, const colour_way *by) {
    lobe_scene *scene = colour_scene(by);
    hold_scene(f, scene);
    const uint64_t hash = picture(f);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
    return hash;
}

/// As a host's passes write images: a copy, in this frame.
static void give(void *user, lobe_graph *graph, const lobe_given_content *content) {
    static const char *const names[COLOUR_SCENE_IMAGES] = {"normals", "colours"};
    lobe_texture *const *textures = user;
    for (size_t i = 0; i < COLOUR_SCENE_IMAGES; i++) {
        const lobe_resource target = lobe_graph_image(
            graph, &(lobe_image_description){.name = names[i],
                                             .format = LOBE_FORMAT_RGBA32_FLOAT,
                                             .width = colours_of_no_normals.width,
                                             .height = colours_of_no_normals.height});
        content->images[i] = lobe_pass_copy(lobe_graph_add_pass(graph, LOBE_PASS_TRANSFER, "give"),
                                            lobe_graph_import_texture(graph, textures[i]),
                                            (lobe_range){0}, target, (lobe_range){0});
    }
}

static const colour_way *const changes[] = {&colours_of_normals, &colours_of_no_normals,
                                            &colours_of_normals};

/// Twice each: once what has been found has come back, the map of colours that do not follow goes.
static void uploaded_colours_may_start_and_stop(void **state) {
    static const uint32_t colours = COLOUR_SCENE_COLOURS;
    const lobe_scene_changes texels = {.images = &colours, .image_count = 1};
    uint64_t expected[3];
    for (int i = 0; i < 3; i++)
        expected[i] = fresh_picture(*state, changes[i]);
    assert_true(expected[0] != expected[1]);
    lobe_scene *scene = colour_scene(&colours_of_no_normals);
    fixture *f = *state;
    hold_scene(f, scene);
    assert_true(picture(f) == expected[1]);
    for (int i = 0; i < 3; i++) {
        colour_scene_recolour(scene, changes[i]);
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &texels), LOBE_OK);
        assert_true(picture(f) == expected[i]);
        assert_true(picture(f) == expected[i]);
    }
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

/// Frames that are waited for know it before they are declared.
static void a_map_that_is_not_needed_is_not_there(void **state) {
    fixture *f = *state;
    lobe_scene *scene = colour_scene(&colours_of_no_normals);
    hold_scene(f, scene);
    for (int i = 0; i < 3; i++) {
        picture(f);
        const lobe_graph *graph = lobe_renderer_graph(f->renderer);
        assert_int_equal(count_passes(graph, "colour_correlation", LOBE_PASS_RUN), 0);
        assert_int_equal(count_passes(graph, "colour_normals", LOBE_PASS_RUN), 0);
        assert_int_equal(count_passes(graph, "parameter_averaging", LOBE_PASS_RUN), i == 0);
    }
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
}

static void written_colours_may_start_and_stop(void **state) {
    fixture *f = *state;
    lobe_texture *textures[COLOUR_SCENE_IMAGES];
    uint64_t expected[3];
    for (int i = 0; i < 3; i++)
        expected[i] = fresh_picture(f, changes[i]);
    lobe_scene *scene = colour_scene(&colours_of_no_normals);
    for (int i = 0; i < COLOUR_SCENE_IMAGES; i++) {
        const lobe_texture_parameters parameters = {.image = &scene->images[i].image};
        assert_int_equal(lobe_texture_create(f->device, &parameters, &textures[i]), LOBE_OK);
        scene->images[i].on_device = true;
    }
    hold_scene(f, scene);
    lobe_renderer_set_content_giver(f->renderer, give, textures);
    for (int i = 0; i < 3; i++) {
        colour_scene_recolour(scene, changes[i]);
        assert_int_equal(lobe_texture_update(textures[COLOUR_SCENE_COLOURS],
                                             &scene->images[COLOUR_SCENE_COLOURS].image),
                         LOBE_OK);
        assert_true(picture(f) == expected[i]);
        assert_true(picture(f) == expected[i]);
    }
    lobe_renderer_set_content_giver(f->renderer, NULL, NULL);
    hold_scene(f, NULL);
    lobe_scene_destroy(&scene);
    for (int i = 0; i < COLOUR_SCENE_IMAGES; i++)
        lobe_texture_destroy(&textures[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_follow_where_they_vary_with_normals),
        cmocka_unit_test(a_map_that_is_not_needed_is_not_there),
        cmocka_unit_test(uploaded_colours_may_start_and_stop),
        cmocka_unit_test(written_colours_may_start_and_stop),
        cmocka_unit_test(validation_is_silent),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
