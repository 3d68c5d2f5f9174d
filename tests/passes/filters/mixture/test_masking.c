// How `mixture` masks: as facets that lie in the surface do, or that close it. The relief that they
// stand for is masked as a whole by `multi_leadr`.
//
// `test_filters_mixture_masking table` prints how far filters are from both, for six maps.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/passes/filters/mixture/changing_materials.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/passes/support/slope_plane.h"

enum { LIGHTS = 6 };

static const char closed[] = "normal_mapping=microfacet";

static const double views[] = {0, 40, 60, 80};
enum { VIEWS = sizeof views / sizeof *views };

/// Above, opposite the viewer at three heights, behind it, and at its side.
static void light_at(int i, double incoming[3]) {
    static const double lights[LIGHTS][2] = {{5, 0},     {30, M_PI}, {60, M_PI},
                                             {75, M_PI}, {50, 0},    {50, 0.5 * M_PI}};
    slope_plane_direction(lights[i][0], lights[i][1], incoming);
}

static lobe_material white_metal(double roughness) {
    return microfacet_material(LOBE_DISTRIBUTION_BECKMANN, roughness, 1);
}

static double draw_plane(fixture *f, const lobe_material *material, const lobe_image *normals,
                         const char *filter, const char *setting, const double outgoing[3],
                         const double incoming[3]) {
    lobe_material mapped;
    lobe_scene *scene = slope_plane(material, normals, outgoing, &mapped);
    slope_plane_add_sun(scene, incoming, 1);
    float colour[3];
    slope_plane_draw(f, scene, filter, setting, colour);
    lobe_scene_destroy(&scene);
    return (double)colour[1];
}

// ---------------------------------------------------------------------------------------------
// Truths

static void normal_of(const lobe_image *map, uint32_t texel, double normal[3]) {
    const float *values = (const float *)map->texels + (size_t)4 * texel;
    double length = 0;
    for (int i = 0; i < 3; i++) {
        normal[i] = 2 * (double)values[i] - 1;
        length += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrt(length);
}

static uint32_t texels_of(const lobe_image *map) {
    return map->width * map->height;
}

/// Facets that lie in the surface: the mean of what each reflects.
static double facets_in_the_surface(const lobe_material *material, const lobe_image *map,
                                    const double outgoing[3], const double incoming[3]) {
    double sum = 0;
    for (uint32_t i = 0; i < texels_of(map); i++) {
        double normal[3], radiance[3];
        normal_of(map, i, normal);
        shade_base_material(material, normal, outgoing, incoming, radiance);
        sum += radiance[1] / texels_of(map);
    }
    return sum;
}

/// Of a height above facets that is normally distributed, the mean of what is above zero.
static double mean_above(double mean, double deviation) {
    if (deviation < 1e-9)
        return fmax(mean, 0);
    const double ratio = mean / deviation;
    return mean * 0.5 * erfc(-ratio * M_SQRT1_2) +
           deviation * exp(-0.5 * ratio * ratio) / sqrt(2 * M_PI);
}

/// Facets of a relief whose slopes are those of the map and of its base lobes, hidden from each
/// other at random (Dupuy et al. 2013, Eqs. 2 and 7).
typedef struct relief {
    double alpha, mean[2];
} relief;

static double visible_area(const relief *r, const lobe_image *map, const double direction[3]) {
    double sum = 0;
    for (uint32_t i = 0; i < texels_of(map); i++) {
        double n[3];
        normal_of(map, i, n);
        const double above = direction[2] + (n[0] * direction[0] + n[1] * direction[1]) / n[2];
        sum += mean_above(above, r->alpha * M_SQRT1_2 * hypot(direction[0], direction[1]));
    }
    return sum / texels_of(map);
}

static double masked_relief(const lobe_material *material, const lobe_image *map,
                            const double outgoing[3], const double incoming[3]) {
    relief r = {.alpha = (double)material->roughness * (double)material->roughness};
    double h[3], length = 0, density = 0;
    for (int i = 0; i < 3; i++) {
        h[i] = outgoing[i] + incoming[i];
        length += h[i] * h[i];
    }
    for (uint32_t i = 0; i < texels_of(map); i++) {
        double n[3];
        normal_of(map, i, n);
        const double x = h[0] / h[2] - n[0] / n[2], y = h[1] / h[2] - n[1] / n[2];
        density += exp(-(x * x + y * y) / (r.alpha * r.alpha)) /
                   (M_PI * r.alpha * r.alpha * texels_of(map));
        r.mean[0] -= n[0] / n[2] / texels_of(map);
        r.mean[1] -= n[1] / n[2] / texels_of(map);
    }
    double planes[2], masking = -1;
    const double *const directions[] = {outgoing, incoming};
    for (int i = 0; i < 2; i++) {
        const double *d = directions[i];
        planes[i] = d[2] - r.mean[0] * d[0] - r.mean[1] * d[1];
        if (planes[i] <= 0)
            return 0;
        masking += visible_area(&r, map, d) / planes[i];
    }
    return density / pow(h[2] / sqrt(length), 4) / (4 * planes[0] * masking);
}

// ---------------------------------------------------------------------------------------------
// Tests

/// Closed surfaces, of which nothing is lost.
static void a_closed_white_surface_reflects_all_light(void **state) {
    const lobe_material material = white_metal(0.3);
    for (int which = 0; which < 2; which++) {
        lobe_image map = slope_plane_bumpy_map(16, which == 0 ? 0.15 : 0.3);
        for (int i = 0; i < VIEWS; i++) {
            const double found =
                slope_plane_furnace(*state, &material, &map, "mixture", closed, views[i]);
            // Where the reference itself has 0.92.
            const double most = views[i] > 70 ? 0.065 : 0.05;
            if (!(fabs(found - 1) <= most))
                fail_msg("%g degrees: %g of the light", views[i], found);
        }
        lobe_image_free(&map);
    }
}

static void light_and_viewer_may_change_places(void **state) {
    const lobe_material material = white_metal(0.6);
    lobe_image map = slope_plane_bumpy_map(16, 0.3);
    for (int i = 0; i < VIEWS * LIGHTS; i++) {
        double a[3], b[3];
        slope_plane_direction(views[i % VIEWS], 0.3, a);
        light_at(i / VIEWS, b);
        const double there = draw_plane(*state, &material, &map, "mixture", closed, a, b) / b[2];
        const double back = draw_plane(*state, &material, &map, "mixture", closed, b, a) / a[2];
        if (!(fabs(there - back) <= 0.02 * there + 1e-4))
            fail_msg("%g degrees, light %d: %.6g there, %.6g back", views[i % VIEWS], i / VIEWS,
                     there, back);
    }
    lobe_image_free(&map);
}

/// `suns` together are as bright as one.
static double draw_below_suns(fixture *f, const lobe_image *normals, int suns) {
    const lobe_material material = white_metal(0.3);
    double outgoing[3], incoming[3];
    slope_plane_direction(40, 0.3, outgoing);
    slope_plane_direction(20, 1, incoming);
    lobe_material mapped;
    lobe_scene *scene = slope_plane(&material, normals, outgoing, &mapped);
    for (int i = 0; i < suns; i++)
        slope_plane_add_sun(scene, incoming, 1.0 / suns);
    scene_end(scene);
    const picture_request request = {.filter = "mixture",
                                     .settings = {closed, "components=6", "blend_error=0"},
                                     .width = 1,
                                     .height = 1};
    lobe_frame frame = draw_scene(f, scene, &request);
    const double found = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
    return found;
}

/// What facets exchange of each light is a loop in a loop for each component of each texel.
static void no_light_is_left_out(void **state) {
    lobe_image map = slope_plane_bumpy_map(16, 0.3);
    const double one = draw_below_suns(*state, &map, 1), many = draw_below_suns(*state, &map, 24);
    if (!(one > 0 && fabs(many / one - 1) <= 1e-3))
        fail_msg("%g under one sun, %g under as much light of 24", one, many);
    lobe_image_free(&map);
}

// ---------------------------------------------------------------------------------------------
// The table

typedef double (*truth)(const lobe_material *material, const lobe_image *map,
                        const double outgoing[3], const double incoming[3]);

/// Of all lights, relative to what they bring.
static double departure(fixture *f, const lobe_image *map, const char *filter, double view,
                        truth truth) {
    const lobe_material material = white_metal(0.5);
    double outgoing[3], incoming[3], difference = 0, whole = 0;
    slope_plane_direction(view, 0, outgoing);
    for (int i = 0; i < LIGHTS; i++) {
        light_at(i, incoming);
        const double expected = truth(&material, map, outgoing, incoming);
        difference +=
            fabs(draw_plane(f, &material, map, filter, NULL, outgoing, incoming) - expected);
        whole += expected;
    }
    return difference / whole;
}

static void print_table(fixture *f) {
    static const int maps[] = {0, 1, 3, 5, 6, 7};
    static const char *const filters[] = {"moments", "mixture", "leadr", "multi_leadr"};
    static const truth truths[] = {facets_in_the_surface, masked_relief};
    for (int m = 0; m < 6; m++) {
        lobe_image colours, map = changing_material(maps[m], 256, &colours);
        for (int i = 0; i < 4; i++)
            for (int t = 0; t < 2; t++) {
                printf("%-18s %-12s %-8s", changing_material_names[maps[m]], filters[i],
                       t == 0 ? "surface" : "relief");
                for (int v = 0; v < VIEWS; v++)
                    printf(" %5.1f", 100 * departure(f, &map, filters[i], views[v], truths[t]));
                printf("\n");
            }
        lobe_image_free(&map);
        lobe_image_free(&colours);
    }
}

int main(int count, char **arguments) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_white_surface_reflects_all_light),
        cmocka_unit_test(light_and_viewer_may_change_places),
        cmocka_unit_test(no_light_is_left_out),
    };
    if (count < 2 || strcmp(arguments[1], "table") != 0)
        return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
    void *state = NULL;
    fixture_create(&state);
    print_table(state);
    fixture_destroy(&state);
    return 0;
}
