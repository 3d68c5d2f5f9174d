// Energy and reciprocity of the microfacet frame, through the whole renderer: a plane under light
// from everywhere, and a plane whose light and viewer are swapped.

#include "tests/passes/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/long_runs.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/lobe/half_vector_lobe.h"
#include "tests/reference/vector.h"

static const char *const distribution_names[] = {"GGX", "Beckmann", "Blinn-Phong", "vMF"};

/// From the tangent frame of scene_add_square to the world.
static void to_world(const double tangent[3], double world[3]) {
    world[0] = tangent[0];
    world[1] = tangent[2];
    world[2] = -tangent[1];
}

static void direction_at(double degrees, double azimuth, double direction[3]) {
    double angle = degrees * M_PI / 180;
    direction[0] = sin(angle) * cos(azimuth);
    direction[1] = sin(angle) * sin(azimuth);
    direction[2] = cos(angle);
}

static void add_sun_from(lobe_scene *scene, const double tangent[3], double intensity) {
    double world[3];
    to_world(tangent, world);
    scene_add_sun(scene, world, intensity);
}

static lobe_scene *mapped_scene(const lobe_material *material, lobe_image normals,
                                const double outgoing[3]) {
    lobe_scene *scene = scene_begin();
    lobe_material mapped = *material;
    mapped.normal_map = scene_add_map(scene, normals);
    scene_add_square(scene, &mapped, 40, NULL);
    double world[3];
    to_world(outgoing, world);
    scene_look_from(scene, world, 0.1);
    return scene;
}

/// A square of a material with a normal map of 8x8 equal texels, flat or tilted, which filters see
/// at level 4: only their filtered maps count.
static lobe_scene *plane_scene(const lobe_material *material, const float texel[3],
                               const double outgoing[3]) {
    return mapped_scene(material, constant_map(8, 8, texel[0], texel[1], texel[2]), outgoing);
}

static double draw_one_pixel(fixture *f, lobe_scene *scene, const char *filter) {
    scene_end(scene);
    picture_request request = {
        .filter = filter, .settings = {NULL}, .width = 1, .height = 1, .samples = 1};
    lobe_frame frame = draw_scene(f, scene, &request);
    double value = (double)pixel_at(&frame.radiance, 0, 0)[1];
    lobe_frame_free(&frame);
    return value;
}

// ---------------------------------------------------------------------------------------------
// White furnace

enum { ROWS = 32, COLUMNS = 31 };

/// Light from everywhere with radiance one, as suns that represent equal parts of the distribution
/// of visible normals: half vectors are those of GGX with the material's alpha (Walter et al. 2007,
/// Eq. 35), a part of d(omega_i) = 4 <o, h> d(omega_h) each. Returns the plane's reflected radiance
/// in double precision.
static double add_furnace(lobe_scene *scene, const lobe_material *material,
                          const double outgoing[3]) {
    double alpha = fmax(pow((double)material->roughness, 2), 0.02), sum = 0;
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        double u = (i / COLUMNS + 0.5) / ROWS, azimuth = 2 * M_PI * (i % COLUMNS + 0.5) / COLUMNS;
        double tangent = alpha * sqrt(u / (1 - u)), cosine = 1 / sqrt(1 + tangent * tangent);
        const double half_vector[3] = {tangent * cosine * cos(azimuth),
                                       tangent * cosine * sin(azimuth), cosine};
        double product = reference_dot(outgoing, half_vector), incoming[3], radiance[3];
        for (int j = 0; j < 3; j++)
            incoming[j] = 2 * product * half_vector[j] - outgoing[j];
        if (product <= 0 || incoming[2] <= 1e-4)
            continue;
        double slope = tangent / alpha, density = cosine / (M_PI * alpha * alpha);
        density /= pow(cosine, 4) * pow(1 + slope * slope, 2);
        double part = 4 * product / (density * ROWS * COLUMNS);
        add_sun_from(scene, incoming, part);
        shade_base_material(material, (double[]){0, 0, 1}, outgoing, incoming, radiance);
        sum += part * radiance[1];
    }
    return sum;
}

/// GGX and Beckmann are masked by their own shadowing function, which loses energy only. The others
/// are masked as Beckmann (Walter et al. 2007, section 5.2), which does not fit broad lobes: they
/// exceed one at grazing angles by as much as is written here.
static double most_reflected(const lobe_material *material) {
    bool own = material->distribution == LOBE_DISTRIBUTION_GGX ||
               material->distribution == LOBE_DISTRIBUTION_BECKMANN;
    return own || material->roughness < 0.5f ? 1.003 : 1.15;
}

/// `tan` and `fournier` have no masking, as printed, and divide by the cosine to the viewer.
static bool is_masked(const char *filter) {
    return strcmp(filter, "tan") != 0 && strcmp(filter, "fournier") != 0;
}

static void check_furnace(fixture *f, const lobe_material *material, double degrees) {
    double outgoing[3];
    direction_at(degrees, 0.3, outgoing);
    lobe_scene *scene = plane_scene(material, (float[]){0.5f, 0.5f, 1}, outgoing);
    double expected = add_furnace(scene, material, outgoing);
    double found = draw_one_pixel(f, scene, "direct");
    char what[96];
    snprintf(what, sizeof what, "%s, roughness %g, %g degrees",
             distribution_names[material->distribution], (double)material->roughness, degrees);
    if (!(fabs(found - expected) <= 1e-3 * expected))
        fail_msg("%s: %.6g instead of %.6g", what, found, expected);
    if (!(found <= most_reflected(material)))
        fail_msg("%s: reflects %g of the light", what, found);
    // Smooth facets lose little; rough ones lose what they reflect to each other.
    double least = material->roughness < 0.5f && degrees < 60 ? 0.96 : 0.3;
    if (!(found >= least))
        fail_msg("%s: only %g of the light is left", what, found);
    // A filter that turns base lobes into its own kind keeps their projected area. A Beckmann lobe
    // as broad as Blinn-Phong's of exponent 0 reflects a third more of itself into the ground.
    bool at_limits = fabs((double)material->roughness - 0.6) > 0.1 && fabs(degrees - 50) > 1;
    for (size_t i = 0; at_limits && i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        double filtered = draw_one_pixel(f, scene, filter);
        if (is_masked(filter) &&
            !(filtered >= 0.75 * least && filtered <= most_reflected(material) + 0.02))
            fail_msg("%s: %s reflects %g of the light", what, filter, filtered);
    }
    lobe_scene_destroy(&scene);
}

static void a_white_plane_reflects_no_more_than_it_gets(void **state) {
    static const double angles[] = {0, 50, 80}, roughnesses[] = {0.3, 0.6, 1};
    for (int distribution = 0; distribution < 4; distribution++) {
        for (int i = 0; i < 9; i++) {
            lobe_material material =
                microfacet_material((lobe_distribution)distribution, roughnesses[i % 3], 1);
            check_furnace(*state, &material, angles[i / 3]);
        }
    }
}

/// Specular and diffuse share the incident light: a white dielectric reflects at most all of it.
static void a_white_dielectric_reflects_no_more_than_it_gets(void **state) {
    static const double angles[] = {0, 50, 80};
    for (int i = 0; i < 3; i++) {
        lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 1, 0);
        check_furnace(*state, &material, angles[i]);
    }
}

/// Normals up to `tilt` radians from the pole.
static void check_rough_surface(fixture *f, const lobe_material *material, double tilt,
                                double degrees) {
    double outgoing[3];
    direction_at(degrees, 0.3, outgoing);
    lobe_scene *scene = mapped_scene(material, random_normal_map(8, 8, tilt, 201), outgoing);
    // Suns where the normals together reflect.
    lobe_material broad = *material;
    broad.roughness = (float)fmax((double)material->roughness, sqrt(tilt));
    add_furnace(scene, &broad, outgoing);
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        const char *filter = lobe_filter_name(lobe_filter_get(i));
        double found = draw_one_pixel(f, scene, filter);
        // A single sample's narrow lobe is missed by suns placed for broad ones, or faces away at
        // grazing angles.
        if (is_masked(filter) && !(found >= (degrees < 60 ? 0.5 : 0) && found <= 1.03))
            fail_msg("%s, tilt %g, %g degrees: %s reflects %g of the light",
                     distribution_names[material->distribution], tilt, degrees, filter, found);
    }
    lobe_scene_destroy(&scene);
}

/// Nor does a plane of normals in all directions, which filters turn into a distribution of their
/// own.
static void a_rough_surface_reflects_no_more_than_it_gets(void **state) {
    static const double angles[] = {0, 50, 80}, tilts[] = {0.2, 0.7};
    for (int distribution = 0; distribution < 4; distribution++) {
        for (int i = 0; i < 6; i++) {
            lobe_material material = microfacet_material((lobe_distribution)distribution, 0.3, 1);
            check_rough_surface(*state, &material, tilts[i / 3], angles[i % 3]);
        }
    }
}

/// The papers' half-vector lobes integrate to one over half vectors, of which 4 <o, h> times as
/// much solid angle is that of the light: a narrow white lobe reflects 4 cos(theta) of what it
/// gets. The table is that of docs/filters-compared.md.
enum { ANGLES = 7 };

static const double energy_angles[ANGLES] = {0, 30, 45, 60, 75, 85, 89};
static const struct {
    lobe_distribution distribution;
    float width; // kappa or exponent
    double energies[ANGLES];
} energies[] = {
    {LOBE_DISTRIBUTION_VMF, 1, {1.01, 0.97, 0.92, 0.85, 0.77, 0.71, 0.68}},
    {LOBE_DISTRIBUTION_VMF, 4, {2.43, 2.16, 1.86, 1.48, 1.08, 0.82, 0.72}},
    {LOBE_DISTRIBUTION_VMF, 16, {3.73, 3.19, 2.56, 1.78, 1.00, 0.57, 0.42}},
    {LOBE_DISTRIBUTION_VMF, 256, {3.98, 3.45, 2.82, 1.99, 1.02, 0.34, 0.14}},
    {LOBE_DISTRIBUTION_BLINN_PHONG, 1, {1.72, 1.63, 1.52, 1.35, 1.14, 0.96, 0.87}},
    {LOBE_DISTRIBUTION_BLINN_PHONG, 4, {2.92, 2.54, 2.12, 1.61, 1.10, 0.78, 0.65}},
    {LOBE_DISTRIBUTION_BLINN_PHONG, 16, {3.77, 3.23, 2.59, 1.80, 1.00, 0.55, 0.40}},
    {LOBE_DISTRIBUTION_BLINN_PHONG, 256, {3.98, 3.45, 2.82, 1.99, 1.02, 0.34, 0.14}},
};

/// What the lobe reflects of light from everywhere: the integral over half vectors, whose cosines
/// are 1 - x^2, so that points are dense about the axis.
static double integrate_energy(lobe_distribution distribution, double width,
                               const double outgoing[3]) {
    enum { STEPS = 2000, TURNS = 200 };
    const double axis[3] = {0, 0, 1};
    double sum = 0;
    for (int i = 0; i < STEPS * TURNS; i++) {
        double x = (i / TURNS + 0.5) / STEPS, azimuth = 2 * M_PI * (i % TURNS + 0.5) / TURNS;
        double cosine = 1 - x * x, sine = sqrt(1 - cosine * cosine);
        const double half_vector[3] = {sine * cos(azimuth), sine * sin(azimuth), cosine};
        double product = reference_dot(outgoing, half_vector);
        if (product > 0 && 2 * product * cosine > outgoing[2])
            sum += 4 * product * 2 * x *
                   reference_half_vector_lobe(distribution, half_vector, axis, width);
    }
    return sum * 2 * M_PI / (STEPS * TURNS);
}

static void half_vector_lobes_have_the_energy_that_is_stated(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof energies / sizeof *energies; i++) {
        for (int k = 0; k < ANGLES; k++) {
            double outgoing[3];
            direction_at(energy_angles[k], 0.3, outgoing);
            const double found =
                integrate_energy(energies[i].distribution, (double)energies[i].width, outgoing);
            if (!(fabs(found - energies[i].energies[k]) <= 0.0055))
                fail_msg("%s, width %g, %g degrees: %g instead of %g",
                         distribution_names[energies[i].distribution], (double)energies[i].width,
                         energy_angles[k], found, energies[i].energies[k]);
        }
    }
}

/// The renderer reflects as much, up to what is missed between the suns.
static void a_white_half_vector_lobe_reflects_more_than_it_gets(void **state) {
    for (size_t i = 0; i < sizeof energies / sizeof *energies * ANGLES; i++) {
        const double degrees = energy_angles[i % ANGLES],
                     stated = energies[i / ANGLES].energies[i % ANGLES];
        const float width = energies[i / ANGLES].width;
        lobe_material material = half_vector_material(energies[i / ANGLES].distribution, width);
        // The suns are those of a lobe of this breadth: alpha^2 = 2/kappa.
        material.roughness = powf(2 / fmaxf(width, 2), 0.25f);
        double outgoing[3];
        direction_at(degrees, 0.3, outgoing);
        lobe_scene *scene = plane_scene(&material, (float[]){0.5f, 0.5f, 1}, outgoing);
        const double expected = add_furnace(scene, &material, outgoing);
        const double found = draw_one_pixel(*state, scene, "direct");
        if (!(fabs(found - expected) <= 1e-3 * expected) || !(fabs(found - stated) <= 0.04))
            fail_msg("%s, width %g, %g degrees: reflects %g, sum of suns %g, integral %g",
                     distribution_names[material.distribution], (double)width, degrees, found,
                     expected, stated);
        lobe_scene_destroy(&scene);
    }
}

// ---------------------------------------------------------------------------------------------
// Reciprocity

/// Reflectance of one light: the pixel without the incident cosine to `normal`.
static double reflectance(fixture *f, const lobe_material *material, const char *filter,
                          const double normal[3], const double outgoing[3],
                          const double incoming[3], bool cosine) {
    float texel[3];
    for (int i = 0; i < 3; i++)
        texel[i] = (float)(0.5 + 0.5 * normal[i]);
    lobe_scene *scene = plane_scene(material, texel, outgoing);
    add_sun_from(scene, incoming, 1);
    double value = draw_one_pixel(f, scene, filter);
    lobe_scene_destroy(&scene);
    return cosine ? value / reference_dot(normal, incoming) : value;
}

static void check_reciprocity(fixture *f, const lobe_material *material, const char *filter,
                              const double normal[3]) {
    static const double angles[][2] = {{0, 60}, {20, 40}, {35, 80}, {85, 10}};
    for (int i = 0; i < 4; i++) {
        double a[3], b[3];
        direction_at(angles[i][0], 0.2, a);
        direction_at(angles[i][1], 2.9, b);
        if (reference_dot(normal, a) < 0.02 || reference_dot(normal, b) < 0.02)
            continue;
        bool cosine = material->model == LOBE_MATERIAL_MICROFACET;
        double there = reflectance(f, material, filter, normal, a, b, cosine);
        double back = reflectance(f, material, filter, normal, b, a, cosine);
        assert_true(there > 0);
        if (!(fabs(there - back) <= 2e-3 * there))
            fail_msg("%s, %s, %g and %g degrees: %.6g there, %.6g back", filter,
                     distribution_names[material->distribution], angles[i][0], angles[i][1], there,
                     back);
    }
}

static void light_and_viewer_may_change_places(void **state) {
    static const double flat[3] = {0, 0, 1}, tilted[3] = {0.28, 0, 0.96};
    for (int distribution = 0; distribution < 4; distribution++) {
        for (size_t i = 0; i < lobe_filter_count(); i++) {
            if (!long_runs() && (i + (size_t)distribution) % 4 != 0)
                continue;
            const char *filter = lobe_filter_name(lobe_filter_get(i));
            lobe_material material = microfacet_material((lobe_distribution)distribution, 0.5, 0.5);
            check_reciprocity(*state, &material, filter, flat);
            check_reciprocity(*state, &material, filter, tilted);
        }
    }
}

/// Half-vector lobes include the cosine: they are symmetric themselves.
static void half_vector_lobes_are_symmetric(void **state) {
    static const double tilted[3] = {0.28, 0, 0.96};
    for (size_t i = 0; i < lobe_filter_count(); i++) {
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 15);
        check_reciprocity(*state, &material, lobe_filter_name(lobe_filter_get(i)), tilted);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_white_plane_reflects_no_more_than_it_gets),
        cmocka_unit_test(a_white_dielectric_reflects_no_more_than_it_gets),
        cmocka_unit_test(a_rough_surface_reflects_no_more_than_it_gets),
        cmocka_unit_test(half_vector_lobes_have_the_energy_that_is_stated),
        cmocka_unit_test(a_white_half_vector_lobe_reflects_more_than_it_gets),
        cmocka_unit_test(light_and_viewer_may_change_places),
        cmocka_unit_test(half_vector_lobes_are_symmetric),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
