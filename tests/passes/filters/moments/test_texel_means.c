// The filter "moments" at its defaults against the mean of what the texels reflect, where the mean
// of their parameters misses it: few steep texels in a polish, colours that go with directions,
// meshes that tint metal, several widths in a bin, normals and widths between those of texels.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/reference/vector.h"

/// Texels of one kind, scattered over the maps.
typedef struct texel_kind {
    double tilt; ///< of the normal, towards +X, degrees
    float roughness, metallic, colour[3];
    uint32_t count;
} texel_kind;

enum { EXTENT = 32, TEXELS = EXTENT * EXTENT };

typedef struct plane {
    const texel_kind *kinds;
    uint32_t kind_count;
    const char *setting; ///< NULL: the defaults
    float tint[3];       ///< the mesh's colour
} plane;

static void put_texel(const texel_kind *kind, float normal[4], float width[4], float colour[4]) {
    double angle = kind->tilt * M_PI / 180;
    normal[0] = (float)(0.5 + 0.5 * sin(angle));
    normal[1] = 0.5f;
    normal[2] = (float)(0.5 + 0.5 * cos(angle));
    width[1] = kind->roughness;
    width[2] = kind->metallic;
    memcpy(colour, kind->colour, sizeof kind->colour);
    normal[3] = width[3] = colour[3] = 1;
}

/// Kinds at hashed places, each as often as it says.
static void put_texels(const plane *p, lobe_image images[3]) {
    uint32_t order[TEXELS], next = 0;
    for (uint32_t i = 0; i < TEXELS; i++) {
        uint32_t other = (uint32_t)(passes_hashed_number(i) * (i + 1));
        order[i] = order[other];
        order[other] = i;
    }
    for (uint32_t k = 0; k < p->kind_count; k++)
        for (uint32_t i = 0; i < p->kinds[k].count; i++, next++)
            put_texel(&p->kinds[k], (float *)images[0].texels + (size_t)4 * order[next],
                      (float *)images[1].texels + (size_t)4 * order[next],
                      (float *)images[2].texels + (size_t)4 * order[next]);
    assert_int_equal(next, TEXELS);
}

static lobe_scene *scene_of(const plane *p, const double outgoing[3]) {
    lobe_image images[3];
    for (int i = 0; i < 3; i++)
        images[i] = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    put_texels(p, images);
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 1), mapped;
    lobe_scene *scene = slope_plane(&material, &images[0], outgoing, &mapped);
    lobe_image_free(&images[0]);
    scene->materials[0].metallic_roughness_map = scene_add_map(scene, images[1]);
    scene->materials[0].metallic_roughness_map.nearest = true;
    scene->materials[0].base_colour_map = scene_add_map(scene, images[2]);
    scene->materials[0].base_colour_map.nearest = true;
    lobe_mesh *mesh = &scene->meshes[0];
    mesh->has_colour = true;
    for (size_t i = 0; i < mesh->vertex_count; i++)
        memcpy(mesh->vertices[i].colour, p->tint, sizeof p->tint);
    return scene;
}

static void draw_plane(fixture *f, const plane *p, const double outgoing[3],
                       const double incoming[3], float found[3]) {
    lobe_scene *scene = scene_of(p, outgoing);
    slope_plane_add_sun(scene, incoming, 1);
    slope_plane_draw(f, scene, "moments", p->setting, found);
    lobe_scene_destroy(&scene);
}

static void mean_of_texels(const plane *p, const double outgoing[3], const double incoming[3],
                           double mean[3]) {
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t k = 0; k < p->kind_count; k++) {
        const texel_kind *kind = &p->kinds[k];
        lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, (double)kind->roughness,
                                                     (double)kind->metallic);
        double normal[3], radiance[3];
        slope_plane_direction(kind->tilt, 0, normal);
        for (int i = 0; i < 3; i++)
            material.base_colour[i] = kind->colour[i] * p->tint[i];
        shade_base_material(&material, normal, outgoing, incoming, radiance);
        for (int i = 0; i < 3; i++)
            mean[i] += radiance[i] * kind->count / TEXELS;
    }
}

/// For a viewer above and half vectors `degrees` from upright, along X.
static void check_plane(fixture *f, const plane *p, const double *degrees, uint32_t count,
                        double tolerance) {
    for (uint32_t i = 0; i < count; i++) {
        double outgoing[3] = {0, 0, 1}, incoming[3], expected[3];
        float found[3];
        slope_plane_direction(2 * degrees[i], 0, incoming);
        draw_plane(f, p, outgoing, incoming, found);
        mean_of_texels(p, outgoing, incoming, expected);
        for (int j = 0; j < 3; j++)
            if (!(fabs((double)found[j] / expected[j] - 1) < tolerance))
                fail_msg("half vector at %g degrees, channel %d: %g instead of %g", degrees[i], j,
                         (double)found[j], expected[j]);
    }
}

/// Alpha is 0.0025: sixteen bits over the range of all normals do not tell the polish from flat.
static void few_steep_texels_leave_the_polish(void **state) {
    static const texel_kind kinds[] = {
        {0, 0.05f, 1, {0.9f, 0.8f, 0.5f}, TEXELS - 7},
        {50, 0.05f, 1, {0.9f, 0.8f, 0.5f}, 3},
        {-35, 0.05f, 1, {0.9f, 0.8f, 0.5f}, 3},
        {12, 0.05f, 1, {0.9f, 0.8f, 0.5f}, 1},
    };
    static const double degrees[] = {0, 0.1, 0.3, 1};
    const plane p = {kinds, 4, NULL, {1, 1, 1}};
    check_plane(*state, &p, degrees, 4, 0.05);
}

/// Red metal that leans to one side and blue metal that leans to the other.
static void colours_that_go_with_directions_are_kept(void **state) {
    static const texel_kind kinds[] = {
        {-20, 0.4f, 1, {0.9f, 0.1f, 0.1f}, TEXELS / 2},
        {20, 0.4f, 1, {0.1f, 0.1f, 0.9f}, TEXELS / 2},
    };
    static const double degrees[] = {-20, 20};
    const plane p = {kinds, 2, NULL, {1, 1, 1}};
    check_plane(*state, &p, degrees, 2, 0.05);
}

/// Between both, where their mean normal would face the viewer more than either.
static void two_sides_have_their_own_cosines(void **state) {
    static const texel_kind kinds[] = {
        {-31, 0.5f, 1, {0.9f, 0.5f, 0.1f}, TEXELS / 2},
        {31, 0.5f, 1, {0.1f, 0.5f, 0.9f}, TEXELS / 2},
    };
    static const double degrees[] = {-8, 0, 4};
    const plane p = {kinds, 2, NULL, {1, 1, 1}};
    check_plane(*state, &p, degrees, 3, 0.03);
}

/// The mesh's colour multiplies that of metal and of what is diffuse, but not the 4 % of a
/// dielectric; and metal does not dim the diffuse light of what is not metal.
static void meshes_tint_metal(void **state) {
    static const texel_kind kinds[] = {
        {0, 0.4f, 1, {0.9f, 0.9f, 0.9f}, TEXELS / 2},
        {0, 0.4f, 0, {0.9f, 0.9f, 0.9f}, TEXELS / 2},
    };
    static const double degrees[] = {0, 10, 30};
    const plane p = {kinds, 2, NULL, {1, 0.05f, 0.2f}};
    check_plane(*state, &p, degrees, 3, 0.02);
}

/// Deviations that are far apart, from the peak to the tails.
static void one_bin_has_several_widths(void **state) {
    static const texel_kind kinds[] = {
        {0, 0.25f, 1, {1, 1, 1}, TEXELS / 4},
        {0, 0.3f, 1, {1, 1, 1}, TEXELS / 2},
        {0, 0.38f, 1, {1, 1, 1}, TEXELS / 4},
    };
    static const double degrees[] = {0, 3, 6, 12, 25, 40};
    const plane p = {kinds, 3, "bins=1", {1, 1, 1}};
    check_plane(*state, &p, degrees, 6, 0.05);
}

/// Polish beside rough patches: a bin has either, and nothing between.
static void one_bin_has_polish_and_rough_patches(void **state) {
    static const texel_kind kinds[] = {
        {0, 0.1f, 1, {1, 1, 1}, TEXELS / 2},
        {0, 0.7f, 1, {1, 1, 1}, TEXELS / 2},
    };
    static const double degrees[] = {0, 6, 12, 25};
    const plane p = {kinds, 2, "bins=1", {1, 1, 1}};
    check_plane(*state, &p, degrees, 4, 0.2);
}

/// Far from the highlights of normals that differ, only the roughest texels are seen.
static void few_rough_texels_are_seen_far_from_highlights(void **state) {
    static const texel_kind kinds[] = {
        {-12, 0.1f, 1, {1, 1, 1}, TEXELS / 16},  {-12, 0.5f, 1, {1, 1, 1}, TEXELS / 16},
        {0, 0.1f, 1, {1, 1, 1}, TEXELS * 3 / 8}, {0, 0.5f, 1, {1, 1, 1}, TEXELS * 3 / 8},
        {12, 0.1f, 1, {1, 1, 1}, TEXELS / 16},   {12, 0.5f, 1, {1, 1, 1}, TEXELS / 16},
    };
    static const double degrees[] = {30, 35, 40};
    const plane p = {kinds, 6, "bins=1", {1, 1, 1}};
    check_plane(*state, &p, degrees, 3, 0.3);
}

// ---------------------------------------------------------------------------------------------
// Between texels

enum { FOLD_DEGREES = 20 };

/// `width` columns of texels lean to one side, as many to the other, and so on; or rows.
static lobe_image folded_map(uint32_t width, bool rows) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, EXTENT, EXTENT);
    for (uint32_t i = 0; i < TEXELS; i++) {
        const uint32_t along = rows ? i / EXTENT : i % EXTENT;
        double normal[3];
        float *texel = (float *)image.texels + (size_t)4 * i;
        slope_plane_direction(FOLD_DEGREES,
                              (rows ? 0.5 : 0) * M_PI + (along / width % 2 ? M_PI : 0), normal);
        for (int j = 0; j < 3; j++)
            texel[j] = (float)(0.5 + 0.5 * normal[j]);
        texel[3] = 1;
    }
    return image;
}

static lobe_material fold_material(void) {
    return microfacet_material(LOBE_DISTRIBUTION_GGX, 0.3, 1);
}

static double draw_once(fixture *f, const char *storage) {
    picture_request request = {
        .filter = "moments", .settings = {storage}, .width = 1, .height = 1, .samples = 1};
    lobe_frame frame = draw(f, &request);
    const double green = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    return green;
}

/// Draws a scene, which it destroys; or, unless `later` is NULL, the frame after that in which all
/// texels change to those of `later`, which it destroys, too.
static double draw_changing(fixture *f, lobe_scene *scene, lobe_scene *later, const char *storage) {
    static const uint32_t maps[] = {0, 1, 2};
    scene_end(scene);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    double green = draw_once(f, storage);
    if (later) {
        for (size_t i = 0; i < scene->image_count; i++)
            memcpy(scene->images[i].image.texels, later->images[i].image.texels,
                   TEXELS * lobe_format_size(LOBE_FORMAT_RGBA32_FLOAT));
        const lobe_scene_changes changes = {.images = maps, .image_count = scene->image_count};
        assert_int_equal(lobe_renderer_update_scene(f->renderer, &changes), LOBE_OK);
        green = draw_once(f, storage);
        lobe_scene_destroy(&later);
    }
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_scene_destroy(&scene);
    return green;
}

static lobe_scene *folded_scene(uint32_t width, bool rows) {
    const double up[3] = {0, 0, 1};
    const lobe_material material = fold_material();
    lobe_image image = folded_map(width, rows);
    lobe_material mapped;
    lobe_scene *scene = slope_plane(&material, &image, up, &mapped);
    lobe_image_free(&image);
    scene->materials[0].normal_map.nearest = false;
    slope_plane_add_sun(scene, up, 1);
    return scene;
}

/// Straight from above, where no texel faces. `changes`: the texels were others in the frame
/// before.
static double draw_folds(fixture *f, uint32_t width, bool changes, const char *storage) {
    return draw_changing(f, folded_scene(width, changes),
                         changes ? folded_scene(width, false) : NULL, storage);
}

/// The units of a bin hold what is interpolated between its texels and those of others: with bins
/// that the host fits, and the device.
static void what_lies_between_texels_is_not_clipped(void **state) {
    for (int changes = 0; changes < 2; changes++) {
        const double found = draw_folds(*state, 2, changes, "storage=snorm16");
        const double expected = draw_folds(*state, 2, changes, "storage=float32");
        if (!(fabs(found / expected - 1) < 0.02))
            fail_msg("%s: %g instead of %g", changes ? "changed" : "new", found, expected);
    }
}

static lobe_scene *interpolated_scene(const plane *p) {
    const double up[3] = {0, 0, 1};
    double incoming[3];
    slope_plane_direction(60, 0, incoming);
    lobe_scene *scene = scene_of(p, up);
    scene->materials[0].normal_map.nearest = false;
    scene->materials[0].metallic_roughness_map.nearest = false;
    slope_plane_add_sun(scene, incoming, 1);
    return scene;
}

/// Far from the highlight. `before`: other texels, of the frame before; or NULL.
static double draw_interpolated(fixture *f, const plane *p, const plane *before,
                                const char *storage) {
    return draw_changing(f, interpolated_scene(before ? before : p),
                         before ? interpolated_scene(p) : NULL, storage);
}

/// Between polish and rough texels lie widths that no texel has. Bins that the host fits, and the
/// device, to texels that lean to the other side before.
static void widths_between_texels_are_not_clipped(void **state) {
    enum { EACH = TEXELS / 64 };
    static const texel_kind kinds[2][5] = {
        {{0, 0.05f, 1, {1, 1, 1}, TEXELS - 4 * EACH},
         {12, 0.95f, 1, {1, 1, 1}, EACH},
         {-12, 0.95f, 1, {1, 1, 1}, EACH},
         {25, 0.95f, 1, {1, 1, 1}, EACH},
         {-25, 0.95f, 1, {1, 1, 1}, EACH}},
        {{0, 0.05f, 1, {1, 1, 1}, TEXELS - 4 * EACH},
         {10, 0.95f, 1, {1, 1, 1}, EACH},
         {-14, 0.95f, 1, {1, 1, 1}, EACH},
         {23, 0.95f, 1, {1, 1, 1}, EACH},
         {-27, 0.95f, 1, {1, 1, 1}, EACH}},
    };
    const plane p = {kinds[0], 5, NULL, {1, 1, 1}}, before = {kinds[1], 5, NULL, {1, 1, 1}};
    for (int changes = 0; changes < 2; changes++) {
        const plane *first = changes ? &before : NULL;
        const double found = draw_interpolated(*state, &p, first, "storage=snorm16");
        const double expected = draw_interpolated(*state, &p, first, "storage=float32");
        if (!(fabs(found / expected - 1) < 0.1))
            fail_msg("%s: %g instead of %g", changes ? "changed" : "new", found, expected);
    }
}

/// Folds of one texel are interpolated everywhere, and two points of a texel show only two normals.
static void narrow_folds_are_read_at_many_points(void **state) {
    enum { STEPS = 256 };
    const lobe_material material = fold_material();
    const double up[3] = {0, 0, 1}, slope = tan(FOLD_DEGREES * M_PI / 180);
    double expected = 0;
    for (int i = 0; i < STEPS; i++) {
        double normal[3] = {slope * (2 * (i + 0.5) / STEPS - 1), 0, 1}, radiance[3];
        reference_normalise(normal);
        shade_base_material(&material, normal, up, up, radiance);
        expected += radiance[1] / STEPS;
    }
    const double found = draw_folds(*state, 1, false, "storage=snorm16");
    if (!(fabs(found / expected - 1) < 0.25))
        fail_msg("%g instead of %g", found, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_steep_texels_leave_the_polish),
        cmocka_unit_test(colours_that_go_with_directions_are_kept),
        cmocka_unit_test(two_sides_have_their_own_cosines),
        cmocka_unit_test(meshes_tint_metal),
        cmocka_unit_test(one_bin_has_several_widths),
        cmocka_unit_test(one_bin_has_polish_and_rough_patches),
        cmocka_unit_test(few_rough_texels_are_seen_far_from_highlights),
        cmocka_unit_test(what_lies_between_texels_is_not_clipped),
        cmocka_unit_test(widths_between_texels_are_not_clipped),
        cmocka_unit_test(narrow_folds_are_read_at_many_points),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
