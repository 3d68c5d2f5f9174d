#include "passes/maps/magnification.h"

#include <math.h>

#include "passes/context/camera.h"
#include "passes/upload/transform.h"

/// What pixels show of a surface, by its depth.
typedef struct pixel_measure {
    vec4 axis; ///< of the view: see passes_camera_axis
    float near_plane;
    float constant, per_depth; ///< the smallest side of a pixel, metres
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
    return measure;
}

static float along(const float axis[3], const float vector[3]) {
    return axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2];
}

/// The smallest depth of the instance's bounds along the view axis.
static float nearest_depth(const device_scene *scene, size_t index, const pixel_measure *pixels) {
    const lobe_instance *instance = &scene->scene->instances[index];
    const lobe_mesh *mesh = &scene->scene->meshes[instance->mesh];
    const float *columns = instance->transform, *origin = columns + 12;
    float nearest = along(pixels->axis, origin) - pixels->axis[3];
    for (int axis = 0; axis < 3; axis++) {
        const float slope = along(pixels->axis, columns + 4 * axis);
        nearest += slope * (slope > 0 ? mesh->minimum : mesh->maximum)[axis];
    }
    return fmaxf(nearest, pixels->near_plane);
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

/// The square of the smallest side of a pixel on the instance, in texture coordinates.
static double square_of_footprint(const device_scene *scene, size_t instance, uint32_t set,
                                  const pixel_measure *pixels) {
    const uint32_t mesh = scene->instances[instance].mesh;
    if (scene->scene->meshes[mesh].on_device || scene->scene->meshes[mesh].deformation)
        return 0; // of unknown place or extent
    const float depth = nearest_depth(scene, instance, pixels);
    const double side = scene->measures[mesh].least_density[set] *
                        (double)(pixels->constant + pixels->per_depth * depth);
    return side * side / square_of_stretch(scene, instance);
}

bool passes_may_be_magnified(const filter_context *context, uint32_t material, uint32_t map,
                             uint32_t width, uint32_t height, double probes, double bias) {
    const device_scene *scene = context->scene;
    const lobe_texture_use *use = scene->materials[material].maps[map].use;
    const pixel_measure pixels = measure_pixels(context);
    const double determinant = (double)use->transform[0][0] * use->transform[1][1] -
                               (double)use->transform[0][1] * use->transform[1][0];
    // The square of the texels along a unit of the texture coordinates.
    const double texels = fabs(determinant) * width * height;
    // A pixel that covers fewer texels magnifies the map.
    const double least = probes * exp2(1 - bias);
    uint32_t next = scene->materials[material].first_instance;
    while (next > 0 &&
           texels * square_of_footprint(scene, next - 1, use->texture_coordinates, &pixels) >=
               least * least)
        next = scene->instances[next - 1].next_of_material;
    return next > 0;
}
