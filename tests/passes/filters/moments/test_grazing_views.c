// The filter "moments" on bumpy surfaces that are seen or lit at grazing angles, where many texels
// face away from the viewer or the light, against the mean of what the texels reflect.

#include "tests/passes/support/fixture.h"

#include <math.h>

#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"
#include "tests/reference/vector.h"

enum { EXTENT = 64 };

/// The azimuths and heights of the lights: above, opposite the viewer, behind it, and at its side.
static void check_material(fixture *f, const lobe_material *material, double slope,
                           double tolerance) {
    static const double lights[][2] = {{0, 0}, {80, M_PI}, {80, 0}, {45, 0.5 * M_PI}};
    static const double views[] = {60, 75};
    lobe_image normals = slope_plane_bumpy_map(EXTENT, slope);
    for (int i = 0; i < 8; i++) {
        const double *light = lights[i % 4];
        double outgoing[3], incoming[3];
        float found[3];
        slope_plane_direction(views[i / 4], 0, outgoing);
        slope_plane_direction(light[0], light[1], incoming);
        lobe_material mapped;
        lobe_scene *scene = slope_plane(material, &normals, outgoing, &mapped);
        slope_plane_add_sun(scene, incoming, 1);
        slope_plane_draw(f, scene, "moments", NULL, found);
        lobe_scene_destroy(&scene);
        double expected = slope_plane_bumpy_radiance(material, EXTENT, slope, outgoing, incoming);
        if (!(fabs((double)found[1] / expected - 1) < tolerance))
            fail_msg("metallic %g, slopes of %g, seen at %g degrees, lit at %g: %g instead of %g",
                     (double)material->metallic, slope, views[i / 4], light[0], (double)found[1],
                     expected);
    }
    lobe_image_free(&normals);
}

static void dielectrics_reflect_what_their_texels_do(void **state) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.8, 0);
    check_material(*state, &material, 0.5, 0.1);
    check_material(*state, &material, 0.25, 0.1);
}

static void metals_reflect_what_their_texels_do(void **state) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, 1);
    // Widest where the light is behind the viewer: only the tails of GGX are seen.
    check_material(*state, &material, 0.4, 0.3);
}

// ---------------------------------------------------------------------------------------------
// Ridges, seen along a slope

enum { RIDGE = 8 }; ///< texels across one

/// Seven gentle texels face one way, the eighth, steep one the other.
static void ridge_normal(uint32_t texel, double normal[3]) {
    const bool steep = texel % RIDGE == 0;
    normal[0] = steep ? -3.0 : 1.0;
    normal[1] = 0;
    normal[2] = steep ? 0.4 : 1.0;
    reference_normalise(normal);
}

static lobe_image ridge_map(void) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, RIDGE, RIDGE);
    for (uint32_t i = 0; i < RIDGE * RIDGE; i++) {
        double normal[3];
        float *texel = (float *)image.texels + (size_t)4 * i;
        ridge_normal(i, normal);
        for (int j = 0; j < 3; j++)
            texel[j] = (float)(0.5 + 0.5 * normal[j]);
        texel[3] = 1;
    }
    return image;
}

/// From where the seven face away.
static void ridges_show_the_side_that_faces_the_viewer(void **state) {
    for (int metal = 0; metal < 2; metal++) {
        lobe_material material =
            microfacet_material(LOBE_DISTRIBUTION_GGX, 0.8, metal ? 1.0f : 0.0f);
        lobe_image normals = ridge_map();
        double outgoing[3], incoming[3], expected = 0;
        float found[3];
        slope_plane_direction(70, M_PI, outgoing);
        slope_plane_direction(50, 0.8 * M_PI, incoming);
        for (uint32_t i = 0; i < RIDGE; i++) {
            double normal[3], radiance[3];
            ridge_normal(i, normal);
            shade_base_material(&material, normal, outgoing, incoming, radiance);
            expected += radiance[1] / RIDGE;
        }
        slope_plane_draw_lit(*state, &material, &normals, "moments", NULL, outgoing, incoming,
                             found);
        if (!(fabs((double)found[1] / expected - 1) < 0.05))
            fail_msg("%s ridges: %g instead of %g", metal ? "metal" : "dielectric",
                     (double)found[1], expected);
        lobe_image_free(&normals);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ridges_show_the_side_that_faces_the_viewer),
        cmocka_unit_test(dielectrics_reflect_what_their_texels_do),
        cmocka_unit_test(metals_reflect_what_their_texels_do),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
