#include "passes/context/camera.h"

#include <float.h>
#include <math.h>

#include "passes/upload/number_check.h"

static void copy(const float source[3], vec3 target) {
    for (int i = 0; i < 3; i++)
        target[i] = source[i];
}

/// Scales by a power of two first, which is exact: squares of tiny and of huge lengths are then
/// neither 0 nor infinite. False, with `vector` unchanged, if it has no length.
static bool normalise(vec3 vector) {
    float largest = fmaxf(fmaxf(fabsf(vector[0]), fabsf(vector[1])), fabsf(vector[2]));
    int exponent;
    if (largest == 0)
        return false;
    frexpf(largest, &exponent);
    for (int i = 0; i < 3; i++)
        vector[i] = ldexpf(vector[i], -exponent);
    glm_vec3_normalize(vector);
    return true;
}

static void view_direction(const lobe_camera *camera, vec3 forward) {
    vec3 eye, target;
    copy(camera->eye, eye);
    copy(camera->target, target);
    glm_vec3_sub(target, eye, forward);
    if (!normalise(forward))
        forward[2] = -1;
}

static lobe_result check_numbers(const number_owner *owner, const lobe_camera *camera) {
    const double angle = camera->vertical_field_of_view;
    lobe_result result = passes_check_numbers(owner, "eye", camera->eye, 3, -INFINITY, INFINITY);
    result = result ? result
                    : passes_check_numbers(owner, "target", camera->target, 3, -INFINITY, INFINITY);
    result =
        result ? result : passes_check_numbers(owner, "up", camera->up, 3, -INFINITY, INFINITY);
    result = result ? result : passes_check_numbers(owner, "shift", camera->shift, 2, -1e6, 1e6);
    result = result ? result : passes_check_numbers(owner, "jitter", camera->jitter, 2, -1e6, 1e6);
    // The greatest float below pi.
    result =
        result ? result : passes_check_number(owner, "vertical_field_of_view", angle, 0, 3.1415925);
    result = result ? result
                    : passes_check_number(owner, "near_plane", camera->near_plane, (double)FLT_MIN,
                                          INFINITY);
    if (result != LOBE_OK || angle > 0)
        return result;
    return passes_check_number(owner, "orthographic_height (the field of view is 0)",
                               camera->orthographic_height, (double)FLT_MIN, INFINITY);
}

lobe_result passes_camera_check(const lobe_camera *camera, const lobe_host *host) {
    const number_owner owner = {host, "render", "camera", NULL, SIZE_MAX};
    vec3 up, difference;
    lobe_result result = check_numbers(&owner, camera);
    copy(camera->up, up);
    for (int i = 0; i < 3; i++)
        difference[i] = camera->target[i] - camera->eye[i];
    if (!result && !normalise(difference))
        result = passes_fail_vector(&owner, "eye", camera->eye, "the target is at the same place");
    if (!result && !normalise(up))
        result = passes_fail_vector(&owner, "up", camera->up, "expected a vector with a length");
    return result == LOBE_ERROR_MALFORMED ? LOBE_ERROR_INVALID_ARGUMENT : result;
}

void passes_camera_rotation(const lobe_camera *camera, mat3 rotation) {
    vec3 forward, up, right;
    view_direction(camera, forward);
    copy(camera->up, up);
    normalise(up);
    glm_vec3_cross(forward, up, right);
    if (glm_vec3_norm(right) < 1e-6f) {
        // Looking along the up vector: use any other.
        vec3 other = {fabsf(forward[0]) < 0.5f, 0, fabsf(forward[0]) >= 0.5f};
        glm_vec3_cross(forward, other, right);
    }
    glm_vec3_normalize(right);
    glm_vec3_cross(right, forward, up);
    for (int column = 0; column < 3; column++) {
        rotation[column][0] = right[column];
        rotation[column][1] = up[column];
        rotation[column][2] = -forward[column];
    }
}

void passes_camera_eye(const lobe_camera *camera, vec4 eye) {
    copy(camera->eye, eye);
    eye[3] = 1;
    if (camera->vertical_field_of_view > 0)
        return;
    view_direction(camera, eye);
    glm_vec3_negate(eye);
    eye[3] = 0;
}

void passes_camera_axis(const lobe_camera *camera, vec4 axis) {
    vec3 eye;
    copy(camera->eye, eye);
    view_direction(camera, axis);
    axis[3] = glm_vec3_dot(axis, eye);
}

/// Distance along the view of a plane just behind the farthest corner of the bounds.
static float far_plane_of(const lobe_camera *camera, const float minimum[3],
                          const float maximum[3]) {
    vec4 axis;
    passes_camera_axis(camera, axis);
    float distance = -axis[3];
    for (int i = 0; i < 3; i++)
        distance += axis[i] * (axis[i] > 0 ? maximum[i] : minimum[i]);
    return 1.01f * distance;
}

static void perspective(const lobe_camera *camera, float aspect, mat4 projection) {
    float scale = 1 / tanf(0.5f * camera->vertical_field_of_view);
    glm_mat4_zero(projection);
    projection[0][0] = scale / aspect;
    projection[1][1] = -scale;
    projection[2][3] = -1;
    projection[3][2] = camera->near_plane; // depth = near / distance: 1 near, 0 at infinity
}

/// Of an orthographic camera: the distance between the planes of depth 1 and 0. Where all lies
/// before the near plane, any will do.
static float depth_range(const lobe_camera *camera, float far_plane) {
    return fmaxf(far_plane - camera->near_plane, 1e-3f * camera->near_plane);
}

static void orthographic(const lobe_camera *camera, float aspect, float far_plane,
                         mat4 projection) {
    float scale = 2 / camera->orthographic_height;
    float depth = depth_range(camera, far_plane);
    glm_mat4_identity(projection);
    projection[0][0] = scale / aspect;
    projection[1][1] = -scale;
    projection[2][2] = 1 / depth;
    projection[3][2] = 1 + camera->near_plane / depth;
}

void passes_camera_shift(const lobe_camera *camera, uint32_t width, uint32_t height,
                         const float sample[2], float shift[2]) {
    // Rasterisation samples at the pixel's centre: the picture moves instead.
    const float x = sample[0] + camera->jitter[0], y = sample[1] + camera->jitter[1];
    shift[0] = (1 - 2 * x - 2 * camera->shift[0] * (float)height) / (float)width;
    shift[1] = (1 - 2 * y) / (float)height - 2 * camera->shift[1];
}

void passes_camera_projection(const lobe_camera *camera, uint32_t width, uint32_t height,
                              const float sample[2], const float minimum[3], const float maximum[3],
                              mat4 world_to_clip) {
    float aspect = (float)width / (float)height;
    mat4 projection, move, view;
    if (camera->vertical_field_of_view > 0)
        perspective(camera, aspect, projection);
    else
        orthographic(camera, aspect, far_plane_of(camera, minimum, maximum), projection);
    glm_mat4_identity(move);
    passes_camera_shift(camera, width, height, sample, move[3]);
    mat3 rotation;
    passes_camera_rotation(camera, rotation);
    glm_mat4_identity(view);
    glm_mat4_ins3(rotation, view);
    vec3 eye, moved;
    copy(camera->eye, eye);
    glm_mat3_mulv(rotation, eye, moved);
    for (int i = 0; i < 3; i++)
        view[3][i] = -moved[i];
    mat4 projected;
    glm_mat4_mul(move, projection, projected);
    glm_mat4_mul(projected, view, world_to_clip);
}

void passes_camera_slope_scale(const lobe_camera *camera, uint32_t height, const float minimum[3],
                               const float maximum[3], float *scale, float *offset) {
    const bool perspective = camera->vertical_field_of_view > 0;
    // Depth is near / distance, so that relative changes are those of the distance, which a pixel's
    // side is proportional to.
    *scale = perspective ? 2 * tanf(0.5f * camera->vertical_field_of_view) / (float)height : 0;
    *offset =
        perspective
            ? 0
            : camera->orthographic_height /
                  ((float)height * depth_range(camera, far_plane_of(camera, minimum, maximum)));
}

void passes_camera_directions(const lobe_camera *camera, uint32_t width, uint32_t height,
                              const float sample[2], vec3 centre, vec3 right, vec3 down) {
    const float half =
        camera->vertical_field_of_view > 0 ? tanf(0.5f * camera->vertical_field_of_view) : 0;
    const float across = half * (float)width / (float)height;
    mat3 rotation;
    float shift[2];
    passes_camera_rotation(camera, rotation);
    passes_camera_shift(camera, width, height, sample, shift);
    for (int i = 0; i < 3; i++) {
        right[i] = across * rotation[i][0];
        down[i] = -half * rotation[i][1];
        centre[i] = -rotation[i][2] - (shift[0] * right[i] + shift[1] * down[i]);
    }
}
