#include "passes/maps/magnification.h"

#include <math.h>

#include "passes/context/camera.h"
#include "passes/context/view_volume.h"
#include "passes/upload/transform.h"

/// A smaller share of level 0 than this, in any pixel, is not seen, and not worth its fetches.
#define LEAST_SHARE 0.0625

/// What pixels show of a surface, by its depth.
typedef struct pixel_measure {
    vec4 axis; ///< of the view: see passes_camera_axis
    float near_plane;
    float constant, per_depth; ///< the smallest side of a pixel, metres
    bool has_volume;           ///< perspective
    view_volume volume;
} pixel_measure;

/// The side is the root of the area that a pixel covers of a surface facing it.
static pixel_measure measure_pixels(const filter_context *context) {
    const lobe_camera *camera = context->view.camera;
    const float height = (float)context->view.height;
    pixel_measure measure = {.near_plane = camera->near_plane};
    passes_camera_axis(camera, measure.axis);
    if (camera->vertical_field_of_view <= 0) {
        measure.constant = camera->orthographic_height / height;
        return measure;
    }
    const float tangent = tanf(0.5f * camera->vertical_field_of_view);
    // Towards the farthest corner of the picture, at angle t to the axis, the area shrinks by cos
    // t.
    const float right = (float)context->view.width / height +
                        2 * (fabsf(camera->shift[0]) + fabsf(camera->jitter[0]) / height),
                down = 1 + 2 * (fabsf(camera->shift[1]) + fabsf(camera->jitter[1]) / height);
    const float cosine = 1 / sqrtf(1 + tangent * tangent * (down * down + right * right));
    measure.per_depth = 2 * tangent / height * sqrtf(cosine);
    measure.has_volume = true;
    passes_view_volume_make(camera, context->view.width, context->view.height, &measure.volume);
    return measure;
}

static float along(const float axis[3], const float vector[3]) {
    return axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2];
}

/// The smallest depth of the instance's bounds along the view axis, seen or not.
static float nearest_depth(const device_scene *scene, size_t index, const pixel_measure *pixels) {
    const lobe_instance *instance = &scene->scene->instances[index];
    const lobe_mesh *mesh = &scene->scene->meshes[instance->mesh];
    const float *columns = instance->transform, *origin = columns + 12;
    float nearest = along(pixels->axis, origin) - pixels->axis[3] - scene->displaced_reach;
    for (int axis = 0; axis < 3; axis++) {
        const float slope = along(pixels->axis, columns + 4 * axis);
        nearest += slope * (slope > 0 ? mesh->minimum : mesh->maximum)[axis];
    }
    return fmaxf(nearest, pixels->near_plane);
}

/// The smallest depth of what the picture shows of the bounds.
static float nearest_seen_depth(const device_scene *scene, size_t index,
                                const pixel_measure *pixels) {
    const lobe_instance *instance = &scene->scene->instances[index];
    const lobe_mesh *mesh = &scene->scene->meshes[instance->mesh];
    return passes_view_volume_nearest(&pixels->volume, instance->transform, mesh->minimum,
                                      mesh->maximum);
}

/// The square of an upper bound of how much the transform stretches a length; exact if it preserves
/// angles.
static double square_of_stretch(const device_scene *scene, size_t instance) {
    const float *transform = scene->scene->instances[instance].transform;
    double sum = 0;
    const float *end = transform + (passes_transform_keeps_angles(transform) ? 4 : 12);
    for (const float *column = transform; column < end; column += 4)
        for (int row = 0; row < 3; row++)
            sum += (double)column[row] * column[row];
    return sum;
}

/// The side of a pixel on the instance at a depth, in texture coordinates: the smallest.
static double side_at(const device_scene *scene, size_t instance, uint32_t set,
                      const pixel_measure *pixels, float depth) {
    const uint32_t mesh = scene->instances[instance].mesh;
    return scene->measures[mesh].least_density[set] *
           (double)(pixels->constant + pixels->per_depth * depth) /
           sqrt(square_of_stretch(scene, instance));
}

/// Whether a pixel may be less wide on the instance than `least`, in texture coordinates. What the
/// picture does not show of the bounds takes longer to find, and is needed near the camera alone.
static bool may_be_narrower(const device_scene *scene, size_t instance, uint32_t set,
                            const pixel_measure *pixels, double least) {
    const uint32_t mesh = scene->instances[instance].mesh;
    if (scene->scene->meshes[mesh].on_device || scene->scene->meshes[mesh].deformation)
        return true; // of unknown place or extent
    if (side_at(scene, instance, set, pixels, nearest_depth(scene, instance, pixels)) >= least)
        return false;
    // Displaced surfaces leave the bounds.
    return !pixels->has_volume || scene->displaced_reach > 0 ||
           side_at(scene, instance, set, pixels, nearest_seen_depth(scene, instance, pixels)) <
               least;
}

bool passes_may_be_magnified(const filter_context *context, uint32_t material, uint32_t map,
                             uint32_t width, uint32_t height, double probes, double bias) {
    const device_scene *scene = context->scene;
    const lobe_texture_use *use = scene->materials[material].maps[map].use;
    const pixel_measure pixels = measure_pixels(context);
    const double determinant = (double)use->transform[0][0] * use->transform[1][1] -
                               (double)use->transform[0][1] * use->transform[1][0];
    // Texels along a unit of the texture coordinates.
    const double texels = sqrt(fabs(determinant) * width * height);
    // A pixel that covers fewer texels magnifies the map.
    const double least = probes * exp2(1 - LEAST_SHARE - bias) / fmax(texels, 1e-30);
    uint32_t next = scene->materials[material].first_instance;
    while (next > 0 && !may_be_narrower(scene, next - 1, use->texture_coordinates, &pixels, least))
        next = scene->instances[next - 1].next_of_material;
    return next > 0;
}
