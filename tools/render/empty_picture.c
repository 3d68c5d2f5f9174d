#include "tools/render/empty_picture.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "scenes/mesh/vector.h"

bool empty_picture_recognise(const lobe_image *radiance) {
    const float *texels = radiance->texels;
    for (size_t i = 0; i < (size_t)radiance->width * radiance->height; i++)
        if (texels[4 * i + 3] > 0)
            return false;
    return true;
}

bool empty_picture_is_black(const lobe_image *radiance) {
    const float *texels = radiance->texels;
    for (size_t i = 0; i < (size_t)radiance->width * radiance->height; i++)
        if (texels[4 * i] != 0 || texels[4 * i + 1] != 0 || texels[4 * i + 2] != 0)
            return false;
    return true;
}

/// The camera's axes, and the tangents of half its angles; of an orthographic one, half its
/// extents.
typedef struct view_frame {
    vector3 eye, right, up, forward;
    double width, height, near_plane;
    bool orthographic;
} view_frame;

/// Triangles by what keeps them out of the picture.
typedef struct triangle_counts {
    size_t beside;  ///< outside of the picture, or behind the camera
    size_t close;   ///< before the near plane
    size_t backs;   ///< single-sided, seen from behind
    size_t visible; ///< nothing that is known here
} triangle_counts;

static view_frame frame_of(const lobe_camera *camera, double aspect) {
    view_frame view = {.eye = vector3_load(camera->eye),
                       .near_plane = camera->near_plane,
                       .orthographic = camera->vertical_field_of_view <= 0};
    view.forward = vector3_subtract(vector3_load(camera->target), view.eye);
    vector3_normalise(&view.forward, 0);
    view.right = vector3_cross(view.forward, vector3_load(camera->up));
    if (!vector3_normalise(&view.right, 1e-9))
        view.right = (vector3){1, 0, 0}; // the view is along the up vector: any side will do
    view.up = vector3_cross(view.right, view.forward);
    view.height = view.orthographic ? 0.5 * camera->orthographic_height
                                    : tan(0.5 * camera->vertical_field_of_view);
    view.width = aspect * view.height;
    return view;
}

/// Distances from the planes of the view, positive inside: left, right, bottom, top, near.
static void distances(const view_frame *view, vector3 point, double inside[5]) {
    const vector3 p = vector3_subtract(point, view->eye);
    const double depth = vector3_dot(p, view->forward);
    const double scale = view->orthographic ? 1 : depth;
    const double x = vector3_dot(p, view->right), y = vector3_dot(p, view->up);
    inside[0] = scale * view->width + x;
    inside[1] = scale * view->width - x;
    inside[2] = scale * view->height + y;
    inside[3] = scale * view->height - y;
    inside[4] = depth - view->near_plane;
}

static bool faces_away(const view_frame *view, const vector3 corner[3]) {
    const vector3 normal = vector3_cross(vector3_subtract(corner[1], corner[0]),
                                         vector3_subtract(corner[2], corner[0]));
    const vector3 towards = view->orthographic ? vector3_scale(view->forward, -1)
                                               : vector3_subtract(view->eye, corner[0]);
    return vector3_dot(normal, towards) <= 0;
}

/// A triangle is surely outside if one plane has all its corners behind it.
static void count_triangle(const view_frame *view, const vector3 corner[3], bool double_sided,
                           triangle_counts *counts) {
    double inside[3][5];
    for (int k = 0; k < 3; k++)
        distances(view, corner[k], inside[k]);
    for (int plane = 0; plane < 4; plane++) {
        if (inside[0][plane] < 0 && inside[1][plane] < 0 && inside[2][plane] < 0) {
            counts->beside++;
            return;
        }
    }
    if (inside[0][4] < 0 && inside[1][4] < 0 && inside[2][4] < 0) {
        const bool behind = inside[0][4] < -view->near_plane;
        counts->beside += behind;
        counts->close += !behind;
    } else if (!double_sided && faces_away(view, corner)) {
        counts->backs++;
    } else {
        counts->visible++;
    }
}

static void count_instance(const view_frame *view, const lobe_scene *scene,
                           const lobe_instance *instance, triangle_counts *counts) {
    const lobe_mesh *mesh = &scene->meshes[instance->mesh];
    const bool double_sided = scene->materials[instance->material].double_sided;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        vector3 corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = vector3_transform(
                instance->transform,
                vector3_load(mesh->vertices[mesh->indices[i + (size_t)k]].position));
        count_triangle(view, corner, double_sided, counts);
    }
}

static void explain_beside(const lobe_scene *scene, const view_frame *view, char *text,
                           size_t size) {
    const vector3 low = vector3_load(scene->minimum), high = vector3_load(scene->maximum);
    const vector3 middle = vector3_scale(vector3_add(low, high), 0.5);
    const bool behind =
        vector3_dot(vector3_subtract(middle, view->eye), view->forward) <= view->near_plane;
    snprintf(text, size,
             "%s, whose middle is at %g,%g,%g and which is %g m across: see --eye and "
             "--target",
             behind ? "the camera looks away from the scene" : "the camera looks past the scene",
             middle.x, middle.y, middle.z, vector3_length(vector3_subtract(high, low)));
}

void empty_picture_explain(const lobe_scene *scene, double aspect, char *text, size_t size) {
    const view_frame view = frame_of(&scene->camera, aspect);
    triangle_counts counts = {0};
    for (size_t i = 0; i < scene->instance_count; i++)
        count_instance(&view, scene, &scene->instances[i], &counts);
    if (counts.visible > 0)
        snprintf(text, size,
                 "what the camera sees is cut out by its alpha mask, or smaller than a "
                 "pixel");
    else if (counts.backs > 0)
        snprintf(text, size,
                 "the camera sees only the backs of single-sided faces, which are not "
                 "drawn: is it inside or behind an object?");
    else if (counts.close > 0)
        snprintf(text, size, "all that the camera sees is nearer than its near plane, %g m",
                 view.near_plane);
    else
        explain_beside(scene, &view, text, size);
}
