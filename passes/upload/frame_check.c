#include "passes/upload/frame_check.h"

#include <math.h>

#include "passes/upload/deformation/deformation_check.h"
#include "passes/upload/number_check.h"
#include "passes/upload/transform.h"

static number_owner owner_of(const lobe_scene *scene, const char *kind, size_t index,
                             const lobe_host *host) {
    return (number_owner){.host = host, .where = scene->name, .kind = kind, .index = index};
}

// ---------------------------------------------------------------------------------------------
// Instances

/// The square of the volume that the three axes would span at right angles.
static double square_of_largest_volume(const float m[16]) {
    double square = 1;
    for (const float *axis = m; axis < m + 12; axis += 4)
        square *= (double)axis[0] * axis[0] + (double)axis[1] * axis[1] + (double)axis[2] * axis[2];
    return square;
}

static bool is_finite(const float m[16]) {
    float sum = 0;
    for (int i = 0; i < 16; i++)
        sum += 0 * m[i];
    return sum == 0;
}

static bool is_affine(const float m[16]) {
    return m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] == 1;
}

static bool is_degenerate(const float m[16]) {
    const double determinant = passes_transform_determinant(m);
    return !(determinant * determinant > 1e-18 * square_of_largest_volume(m));
}

static lobe_result fail_transform(const lobe_scene *scene, size_t instance, const lobe_host *host) {
    const number_owner owner = owner_of(scene, "instance", instance, host);
    const float *m = scene->instances[instance].transform;
    if (!is_finite(m))
        return passes_check_numbers(&owner, "transform", m, 16, -INFINITY, INFINITY);
    if (!is_affine(m))
        return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                              "%s: instance %zu: the last row of its transform is (%g, %g, %g, "
                              "%g); expected (0, 0, 0, 1)",
                              scene->name, instance, (double)m[3], (double)m[7], (double)m[11],
                              (double)m[15]);
    return lobe_host_fail(host, LOBE_ERROR_MALFORMED,
                          "%s: instance %zu: its transform has the determinant %g: it is "
                          "degenerate",
                          scene->name, instance, passes_transform_determinant(m));
}

lobe_result passes_check_transform(const lobe_scene *scene, size_t instance,
                                   const lobe_host *host) {
    const float *m = scene->instances[instance].transform;
    if (is_finite(m) && is_affine(m) && !is_degenerate(m))
        return LOBE_OK;
    return fail_transform(scene, instance, host);
}

// ---------------------------------------------------------------------------------------------
// Lights

static lobe_result check_cones(const number_owner *owner, const lobe_light *light) {
    // Half a circle may be rounded up.
    lobe_result result =
        passes_check_number(owner, "outer_cone", light->outer_cone, 0, M_PI / 2 + 1e-6);
    return result
               ? result
               : passes_check_number(owner, "inner_cone", light->inner_cone, 0, light->outer_cone);
}

static lobe_result check_light(const lobe_scene *scene, size_t index, const lobe_host *host) {
    const lobe_light *light = &scene->lights[index];
    const number_owner owner = owner_of(scene, "light", index, host);
    lobe_result result =
        passes_check_number(&owner, "type", light->type, LOBE_LIGHT_DIRECTIONAL, LOBE_LIGHT_SPOT);
    result = result ? result
                    : passes_check_numbers(&owner, "intensity", light->intensity, 3, 0, INFINITY);
    if (!result && light->type != LOBE_LIGHT_POINT)
        result = passes_check_direction(&owner, "direction", light->direction);
    if (!result && light->type == LOBE_LIGHT_SPOT)
        result = check_cones(&owner, light);
    if (result || light->type == LOBE_LIGHT_DIRECTIONAL)
        return result;
    result = passes_check_numbers(&owner, "position", light->position, 3, -INFINITY, INFINITY);
    return result ? result : passes_check_number(&owner, "range", light->range, 0, INFINITY);
}

// ---------------------------------------------------------------------------------------------
// The rest of the scene

static lobe_result check_bounds(const lobe_scene *scene, const lobe_host *host) {
    const number_owner owner = owner_of(scene, "bounds", SIZE_MAX, host);
    lobe_result result =
        passes_check_numbers(&owner, "minimum", scene->minimum, 3, -INFINITY, INFINITY);
    result = result
                 ? result
                 : passes_check_numbers(&owner, "maximum", scene->maximum, 3, -INFINITY, INFINITY);
    for (int axis = 0; !result && axis < 3; axis++) {
        if (scene->minimum[axis] > scene->maximum[axis])
            result = passes_fail_vector(&owner, "minimum", scene->minimum,
                                        "expected to be below the maximum");
    }
    return result;
}

static lobe_result check_environment(const lobe_scene *scene, const lobe_host *host) {
    const lobe_environment *environment = scene->environment;
    if (!environment)
        return LOBE_OK;
    const number_owner owner = {
        .host = host, .where = scene->name, .kind = "environment", .name = environment->name};
    lobe_result result =
        passes_check_number(&owner, "intensity", environment->intensity, 0, INFINITY);
    for (int i = 0; !result && i < 3; i++) {
        const float *a = environment->world_from_environment[i];
        const float *b = environment->world_from_environment[(i + 1) % 3];
        result = passes_check_direction(&owner, "a column of world_from_environment", a);
        if (!result && !(fabsf(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) < 1e-3f))
            result = passes_fail_vector(&owner, "a column of world_from_environment", a,
                                        "expected to be at right angles to the others");
    }
    return result;
}

lobe_result passes_check_frame(const lobe_scene *scene, const lobe_host *host) {
    lobe_result result = LOBE_OK;
    if (scene->light_count > 0 && !scene->lights)
        result = lobe_host_fail(host, LOBE_ERROR_MALFORMED, "%s: %zu lights, but no array of them",
                                scene->name, scene->light_count);
    for (size_t i = 0; !result && i < scene->instance_count; i++)
        result = passes_check_transform(scene, i, host);
    for (size_t i = 0; !result && i < scene->light_count; i++)
        result = check_light(scene, i, host);
    result = result ? result : passes_check_poses(scene, host);
    const number_owner owner = owner_of(scene, "scene", SIZE_MAX, host);
    result = result ? result : check_bounds(scene, host);
    result = result ? result
                    : passes_check_numbers(&owner, "background", scene->background, 3, 0, INFINITY);
    return result ? result : check_environment(scene, host);
}
