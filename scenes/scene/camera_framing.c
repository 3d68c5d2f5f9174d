#include <math.h>

#include <lobe/scene.h>

#include "scenes/mesh/vector.h"

#define FIELD_OF_VIEW (40 * M_PI / 180)
// Fraction of the picture's width or height that the scene fills.
#define FILLED 0.95

/// The picture's axes in the world, relative to a centre, which keeps small scenes far from the
/// origin precise.
typedef struct picture_axes {
    vector3 centre, right, up, forward;
} picture_axes;

/// Along one axis of the picture, all lines of sight lie between two planes through the eye. A
/// point at (x, z), z forward, lies between them if |x - eye_x| <= t (z - eye_z), where t is the
/// tangent of half the angle: so low = max(x - t z) <= eye_x - t eye_z and eye_x + t eye_z <=
/// min(x + t z) = high.
typedef struct picture_extent {
    double tangent, low, high;
} picture_extent;

/// Where the eye may be along one axis of the picture, and the largest tangents to either side as
/// seen from the middle of that range.
typedef struct eye_range {
    double low, high, below, above;
} eye_range;

typedef struct picture_frame {
    const lobe_scene *scene;
    picture_axes axes;
    double radius; ///< of the scene's bounds
    picture_extent across, upright;
    double nearest; ///< smallest z
    double eye;     ///< z of the eye
    eye_range eye_across, eye_upright;
} picture_frame;

typedef void visit(picture_frame *frame, double across, double upright, double forward);

static picture_axes axes_about(vector3 centre) {
    picture_axes axes = {.centre = centre};
    // From the front, a little from the right and above, which shows three sides of a box.
    axes.forward = (vector3){-0.5, -0.4, -1};
    vector3_normalise(&axes.forward, 0);
    axes.right = vector3_cross(axes.forward, (vector3){0, 1, 0});
    vector3_normalise(&axes.right, 0);
    axes.up = vector3_cross(axes.right, axes.forward);
    return axes;
}

static void visit_point(picture_frame *frame, visit *visit, vector3 point) {
    const vector3 p = vector3_subtract(point, frame->axes.centre);
    visit(frame, vector3_dot(p, frame->axes.right), vector3_dot(p, frame->axes.up),
          vector3_dot(p, frame->axes.forward));
}

/// The corners of the bounds, where vertices are found on the device.
static void visit_bounds(picture_frame *frame, visit *visit, const lobe_instance *instance,
                         const lobe_mesh *mesh) {
    for (int corner = 0; corner < 8; corner++)
        visit_point(frame, visit,
                    vector3_transform(instance->transform,
                                      (vector3){corner & 1 ? mesh->maximum[0] : mesh->minimum[0],
                                                corner & 2 ? mesh->maximum[1] : mesh->minimum[1],
                                                corner & 4 ? mesh->maximum[2] : mesh->minimum[2]}));
}

static void visit_points(picture_frame *frame, visit *visit) {
    const lobe_scene *scene = frame->scene;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const lobe_instance *instance = &scene->instances[i];
        const lobe_mesh *mesh = &scene->meshes[instance->mesh];
        if (mesh->deformation)
            visit_bounds(frame, visit, instance, mesh);
        for (size_t k = 0; !mesh->deformation && k < mesh->vertex_count; k++) {
            const vector3 position = vector3_load(mesh->vertices[k].position);
            visit_point(frame, visit, vector3_transform(instance->transform, position));
        }
    }
    if (frame->radius > 0)
        return;
    // An empty scene or a single point is framed as if it were a cube.
    for (int corner = 0; corner < 8; corner++)
        visit_point(
            frame, visit,
            vector3_add(frame->axes.centre,
                        (vector3){corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1}));
}

// ---------------------------------------------------------------------------------------------
// The closest position of the eye

static void extend(picture_extent *extent, double x, double z) {
    extent->low = fmax(extent->low, x - extent->tangent * z);
    extent->high = fmin(extent->high, x + extent->tangent * z);
}

static void include(picture_frame *frame, double across, double upright, double forward) {
    extend(&frame->across, across, forward);
    extend(&frame->upright, upright, forward);
    frame->nearest = fmin(frame->nearest, forward);
}

static double nearest_eye(const picture_extent *extent) {
    return (extent->high - extent->low) / (2 * extent->tangent);
}

static void approach(picture_frame *frame) {
    visit_points(frame, include);
    // Otherwise the eye would come too close to a long object that points at it.
    const double closest = frame->nearest - frame->radius / 2;
    frame->eye = fmin(fmin(nearest_eye(&frame->across), nearest_eye(&frame->upright)), closest);
}

// ---------------------------------------------------------------------------------------------
// The eye's sideways position, which leaves equal space on both sides

static eye_range range_from(const picture_extent *extent, double eye) {
    return (eye_range){.low = extent->low + extent->tangent * eye,
                       .high = extent->high - extent->tangent * eye};
}

static double middle(const eye_range *range) {
    return (range->low + range->high) / 2;
}

static void look(eye_range *range, double x, double distance) {
    const double tangent = (x - middle(range)) / distance;
    range->above = fmax(range->above, tangent);
    range->below = fmax(range->below, -tangent);
}

static void look_at(picture_frame *frame, double across, double upright, double forward) {
    look(&frame->eye_across, across, forward - frame->eye);
    look(&frame->eye_upright, upright, forward - frame->eye);
}

/// Keeps the half in which the eye sees both ends under more equal angles.
static void halve(eye_range *range) {
    if (range->above > range->below)
        range->low = middle(range);
    else
        range->high = middle(range);
    range->above = range->below = 0;
}

static void centre(picture_frame *frame) {
    // Leaves 1/256 of the initial range.
    const int steps = 8;
    frame->eye_across = range_from(&frame->across, frame->eye);
    frame->eye_upright = range_from(&frame->upright, frame->eye);
    for (int i = 0; i < steps; i++) {
        visit_points(frame, look_at);
        halve(&frame->eye_across);
        halve(&frame->eye_upright);
    }
}

void lobe_scene_frame(const lobe_scene *scene, double aspect, lobe_camera *camera) {
    if (!scene || !camera)
        return;
    if (!(aspect > 0) || !isfinite(aspect))
        aspect = 1;
    const vector3 low = vector3_load(scene->minimum), high = vector3_load(scene->maximum);
    const double tangent = FILLED * tan(FIELD_OF_VIEW / 2);
    picture_frame frame = {.scene = scene,
                           .axes = axes_about(vector3_scale(vector3_add(low, high), 0.5)),
                           .radius = 0.5 * vector3_length(vector3_subtract(high, low)),
                           .across = {aspect * tangent, -INFINITY, INFINITY},
                           .upright = {tangent, -INFINITY, INFINITY},
                           .nearest = INFINITY};
    approach(&frame);
    centre(&frame);
    const picture_axes *axes = &frame.axes;
    const vector3 aside = vector3_add(vector3_scale(axes->right, middle(&frame.eye_across)),
                                      vector3_scale(axes->up, middle(&frame.eye_upright)));
    const vector3 target = vector3_add(axes->centre, aside);
    *camera = (lobe_camera){
        .up = {0, 1, 0},
        .vertical_field_of_view = (float)FIELD_OF_VIEW,
        .near_plane = (float)(0.01 * (frame.nearest - frame.eye)),
    };
    vector3_store(target, camera->target);
    vector3_store(vector3_add(target, vector3_scale(axes->forward, frame.eye)), camera->eye);
}
