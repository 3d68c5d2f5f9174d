#include "passes/maps/magnification.h"

#include <math.h>

#include "passes/context/camera.h"

/// The smallest depth of the instance's bounds along the view axis.
static float nearest_depth(const filter_context *context, size_t index) {
    const lobe_instance *instance = &context->scene->scene->instances[index];
    const lobe_mesh *mesh = &context->scene->scene->meshes[instance->mesh];
    vec4 axis;
    passes_camera_axis(context->view.camera, axis);
    float nearest = INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        float depth = -axis[3];
        for (int row = 0; row < 3; row++) {
            float position = instance->transform[12 + row];
            for (int column = 0; column < 3; column++)
                position += instance->transform[4 * column + row] *
                            (corner >> column & 1 ? mesh->maximum : mesh->minimum)[column];
            depth += axis[row] * position;
        }
        nearest = fminf(nearest, depth);
    }
    return fmaxf(nearest, context->view.camera->near_plane);
}

/// The smallest side of a pixel at a depth: the root of the area it covers of a surface facing it.
static float pixel_size(const filter_context *context, float depth) {
    const lobe_camera *camera = context->view.camera;
    float height = (float)context->view.height;
    if (camera->vertical_field_of_view <= 0)
        return camera->orthographic_height / height;
    float tangent = tanf(0.5f * camera->vertical_field_of_view);
    float aspect = (float)context->view.width / height;
    // Towards the corner of the picture, at angle t to the axis, the area shrinks by cos t.
    float cosine = 1 / sqrtf(1 + tangent * tangent * (1 + aspect * aspect));
    return 2 * tangent * depth / height * sqrtf(cosine);
}

/// An upper bound of how much the transform stretches a length; exact if it preserves angles.
static float stretch(const filter_context *context, size_t instance) {
    const float *transform = context->scene->scene->instances[instance].transform;
    double sum = 0;
    int columns = context->scene->instances[instance].keeps_angles ? 1 : 3;
    for (int column = 0; column < columns; column++) {
        for (int row = 0; row < 3; row++)
            sum += (double)transform[4 * column + row] * transform[4 * column + row];
    }
    return (float)sqrt(sum);
}

bool passes_may_be_magnified(const filter_context *context, uint32_t material, uint32_t map,
                             uint32_t width, uint32_t height, double probes, double bias) {
    const device_scene *scene = context->scene;
    const lobe_texture_use *use = scene->materials[material].maps[map].use;
    double determinant = (double)use->transform[0][0] * use->transform[1][1] -
                         (double)use->transform[0][1] * use->transform[1][0];
    double texels = sqrt(fabs(determinant) * width * height);
    for (size_t i = 0; i < scene->scene->instance_count; i++) {
        if (scene->instances[i].material != material)
            continue;
        const mesh_measures *mesh = &scene->measures[scene->instances[i].mesh];
        float density = mesh->least_density[use->texture_coordinates] / stretch(context, i);
        double footprint = texels * density * pixel_size(context, nearest_depth(context, i));
        if (!(log2(footprint / probes) + bias >= 1))
            return true;
    }
    return false;
}
