#include "passes/renderer/shadows/shadow_views.h"

#include <math.h>
#include <string.h>

#include "passes/context/camera.h"

/// Of a spot that one view covers, radians.
#define WIDEST_CONE 1.309f
/// Between triangles of one plane, texels.
#define PLANE_TOLERANCE 0.05f
/// Depths change by at most so many texels from one to the next.
#define STEEPEST 1000.0f
/// Texels around what a view is for, so that those beside it are there.
#define BORDER 2

static float at_least(float a, float b) {
    return a > b ? a : b;
}

// ---------------------------------------------------------------------------------------------
// Receivers

static void corner_of(const float minimum[3], const float maximum[3], int index, float corner[3]) {
    for (int i = 0; i < 3; i++)
        corner[i] = index >> i & 1 ? maximum[i] : minimum[i];
}

/// The distances along the view between which the bounds lie.
static void depths_of(const lobe_camera *camera, const float minimum[3], const float maximum[3],
                      float *near, float *far) {
    vec4 axis;
    passes_camera_axis(camera, axis);
    *near = *far = -axis[3];
    for (int i = 0; i < 3; i++) {
        *near += axis[i] * (axis[i] > 0 ? minimum[i] : maximum[i]);
        *far += axis[i] * (axis[i] > 0 ? maximum[i] : minimum[i]);
    }
    *near = at_least(*near, camera->near_plane);
}

/// The picture's corner, at a distance along the view.
static void picture_corner(const filter_view *view, float x, float y, float depth,
                           float corner[3]) {
    static const float middle[2] = {0.5f, 0.5f};
    const lobe_camera *camera = view->camera;
    const bool perspective = camera->vertical_field_of_view > 0;
    const float half = 0.5f * camera->orthographic_height;
    const float across = half * (float)view->width / (float)view->height;
    vec3 centre, right, down;
    float shift[2];
    mat3 rotation;
    passes_camera_directions(camera, view->width, view->height, middle, centre, right, down);
    passes_camera_shift(camera, view->width, view->height, middle, shift);
    passes_camera_rotation(camera, rotation);
    for (int i = 0; i < 3; i++)
        corner[i] = camera->eye[i] + (perspective ? depth * (centre[i] + x * right[i] + y * down[i])
                                                  : -depth * rotation[i][2] +
                                                        across * (x - shift[0]) * rotation[i][0] -
                                                        half * (y - shift[1]) * rotation[i][1]);
}

shadow_receivers passes_shadow_receivers(const filter_view *view, const float minimum[3],
                                         const float maximum[3]) {
    shadow_receivers receivers;
    float near, far;
    memcpy(receivers.minimum, minimum, sizeof receivers.minimum);
    memcpy(receivers.maximum, maximum, sizeof receivers.maximum);
    depths_of(view->camera, minimum, maximum, &near, &far);
    for (int i = 0; i < 8; i++) {
        if (far > near)
            picture_corner(view, i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? far : near,
                           receivers.corners[i]);
        else
            corner_of(minimum, maximum, i, receivers.corners[i]);
    }
    return receivers;
}

// ---------------------------------------------------------------------------------------------
// Views

uint32_t passes_shadow_view_count(const lobe_light *light) {
    const bool one = light->type == LOBE_LIGHT_DIRECTIONAL ||
                     (light->type == LOBE_LIGHT_SPOT && light->outer_cone <= WIDEST_CONE);
    return one ? 1 : 6;
}

/// Any direction across another one.
static void set_up(lobe_camera *view, const float along[3]) {
    const bool steep = fabsf(along[1]) > 0.9f * glm_vec3_norm((float *)along);
    view->up[0] = steep ? 1 : 0;
    view->up[1] = steep ? 0 : 1;
}

static float diagonal_of(const shadow_receivers *receivers) {
    float square = 0;
    for (int i = 0; i < 3; i++) {
        const float side = receivers->maximum[i] - receivers->minimum[i];
        square += side * side;
    }
    return at_least(sqrtf(square), 1e-30f);
}

/// Intervals along the axes of the light's view.
typedef struct light_box {
    float low[3], high[3];
} light_box;

static void hold(light_box *box, mat3 rotation, const float point[3]) {
    vec3 turned;
    glm_mat3_mulv(rotation, (float *)point, turned);
    for (int i = 0; i < 3; i++) {
        box->low[i] = fminf(box->low[i], turned[i]);
        box->high[i] = fmaxf(box->high[i], turned[i]);
    }
}

/// Across the light, what is both in the picture and in the scene; along it, all of the scene.
static light_box find_box(mat3 rotation, const shadow_receivers *receivers) {
    light_box seen = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    light_box all = seen;
    for (int i = 0; i < 8; i++) {
        float corner[3];
        corner_of(receivers->minimum, receivers->maximum, i, corner);
        hold(&all, rotation, corner);
        hold(&seen, rotation, receivers->corners[i]);
    }
    for (int i = 0; i < 2; i++) {
        const float low = fmaxf(seen.low[i], all.low[i]), high = fminf(seen.high[i], all.high[i]);
        if (low < high) {
            all.low[i] = low;
            all.high[i] = high;
        }
    }
    return all;
}

/// The next of the sizes that views have: eight of them to an octave.
static float rounded_up(float size) {
    return exp2f(ceilf(8 * log2f(size)) / 8);
}

/// Width or height of a view that holds an interval, with its border.
static float size_of_view(float low, float high, float least, uint32_t extent) {
    const float wanted = at_least(high - low, least);
    return rounded_up(wanted * (float)extent / (float)(extent - 2 * BORDER - 2));
}

static shadow_camera parallel_view(const lobe_light *light, const shadow_receivers *receivers,
                                   uint32_t extent) {
    lobe_camera view = {.vertical_field_of_view = 0};
    for (int i = 0; i < 3; i++)
        view.target[i] = light->direction[i];
    set_up(&view, light->direction);
    mat3 rotation;
    passes_camera_rotation(&view, rotation);
    const light_box box = find_box(rotation, receivers);
    const float diagonal = diagonal_of(receivers);
    float size[2];
    vec3 eye = {0, 0, box.high[2] + 1e-2f * diagonal};
    for (int i = 0; i < 2; i++) {
        size[i] = size_of_view(box.low[i], box.high[i], 1e-6f * diagonal, extent);
        const float texel = size[i] / (float)extent;
        eye[i] = texel * floorf(0.5f * (box.low[i] + box.high[i]) / texel);
    }
    mat3 inverse;
    glm_mat3_transpose_to(rotation, inverse);
    glm_mat3_mulv(inverse, eye, view.eye);
    for (int i = 0; i < 3; i++)
        view.target[i] = view.eye[i] - diagonal * rotation[i][2];
    view.orthographic_height = size[1];
    view.near_plane = 5e-3f * diagonal;
    return (shadow_camera){.camera = view, .aspect = size[0] / size[1]};
}

static shadow_camera view_from_point(const lobe_light *light, uint32_t index,
                                     const shadow_receivers *receivers, uint32_t extent) {
    const bool one = passes_shadow_view_count(light) == 1;
    const float border = (float)extent / (float)(extent - 2 * BORDER);
    const float half = one ? at_least(light->outer_cone, 1e-3f) : 0.25f * GLM_PIf;
    const float diagonal = diagonal_of(receivers);
    float along[3] = {0};
    lobe_camera view = {.vertical_field_of_view = 2 * atanf(border * tanf(half)),
                        .near_plane = 1e-4f * diagonal};
    if (one)
        memcpy(along, light->direction, sizeof along);
    else
        along[index / 2] = index % 2 == 0 ? 1 : -1;
    set_up(&view, along);
    for (int i = 0; i < 3; i++) {
        view.eye[i] = light->position[i];
        view.target[i] = light->position[i] + diagonal * along[i];
    }
    return (shadow_camera){.camera = view, .aspect = 1};
}

shadow_camera passes_shadow_view(const lobe_light *light, uint32_t index,
                                 const shadow_receivers *receivers, uint32_t extent) {
    return light->type == LOBE_LIGHT_DIRECTIONAL ? parallel_view(light, receivers, extent)
                                                 : view_from_point(light, index, receivers, extent);
}

void passes_shadow_projection(const shadow_camera *view, const shadow_receivers *receivers,
                              uint32_t extent, const float place[2], mat4 world_to_clip) {
    passes_camera_projection(&view->camera, extent, extent, place, receivers->minimum,
                             receivers->maximum, world_to_clip);
    if (view->aspect == 1)
        return;
    // Of a parallel view, w is 1: all but the shift by part of a texel becomes narrower.
    float shift[2];
    passes_camera_shift(&view->camera, extent, extent, place, shift);
    world_to_clip[3][0] -= shift[0];
    for (int column = 0; column < 4; column++)
        world_to_clip[column][0] /= view->aspect;
    world_to_clip[3][0] += shift[0];
}

void passes_shadow_tolerance(const shadow_camera *shadow, const shadow_receivers *receivers,
                             uint32_t extent, float tolerance[4]) {
    const lobe_camera *view = &shadow->camera;
    float largest = 0; // coordinates are rounded to a part of it
    for (int i = 0; i < 3; i++)
        largest = at_least(largest, fmaxf(fabsf(receivers->minimum[i]), //
                                          fabsf(receivers->maximum[i])));
    memset(tolerance, 0, 4 * sizeof *tolerance);
    if (view->vertical_field_of_view > 0) {
        const float half = tanf(0.5f * view->vertical_field_of_view);
        tolerance[1] = PLANE_TOLERANCE * 2 * half / (float)extent + 4e-6f;
        tolerance[3] = STEEPEST * half;
        return;
    }
    // Depth changes by 1 over the scene and the margin in front of it.
    vec4 axis;
    passes_camera_axis(view, axis);
    float far = -axis[3];
    for (int i = 0; i < 3; i++)
        far += axis[i] * (axis[i] > 0 ? receivers->maximum[i] : receivers->minimum[i]);
    const float depth = at_least(1.01f * far - view->near_plane, 1e-3f * view->near_plane);
    const float size = view->orthographic_height * at_least(shadow->aspect, 1);
    const float texel = size / (float)extent;
    tolerance[0] = (PLANE_TOLERANCE * texel + 1e-6f * largest) / depth + 4e-7f;
    tolerance[2] = STEEPEST * 0.5f * size / depth;
}
