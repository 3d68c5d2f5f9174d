#include "passes/renderer/background.h"

#include "passes/context/camera.h"
#include "shaders/interface/background.h"

/// Rotates a vector of the world into the environment's space; writes three numbers.
static void environment_from_world(const lobe_environment *environment, const float vector[3],
                                   float rotated[3]) {
    // The inverse of a rotation is its transpose.
    for (int column = 0; column < 3; column++) {
        const float *axis = environment->world_from_environment[column];
        rotated[column] = axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2];
    }
}

void passes_background(lobe_pass *pass, const filter_context *context, lobe_resource cube,
                       const shading_sample *sample, bool aov, const lobe_draw *form) {
    const lobe_environment *environment = context->scene->scene->environment;
    vec3 centre, right, down;
    passes_camera_directions(context->view.camera, context->view.width, context->view.height,
                             sample->position, centre, right, down);
    struct background_constants constants = {0};
    environment_from_world(environment, centre, constants.centre);
    environment_from_world(environment, right, constants.right);
    environment_from_world(environment, down, constants.down);
    constants.centre[3] = environment->intensity;
    if (!context->filter->supersamples)
        constants.right[3] = 4 * glm_vec3_norm(right) * glm_vec3_norm(down) * sample->footprint *
                             sample->footprint /
                             ((float)context->view.width * (float)context->view.height);
    lobe_binding binding = {
        .name = "environment_cube",
        .resource = cube,
        .sampler = {LOBE_SAMPLE_LINEAR, LOBE_SAMPLE_LINEAR, LOBE_WRAP_CLAMP, LOBE_WRAP_CLAMP, 0}};
    lobe_draw draw = *form;
    draw.vertex_shader = "shading/background.vert";
    draw.fragment_shader = aov ? "shading/background_aov.frag" : "shading/background.frag";
    draw.index_count = 3;
    draw.constants = &constants;
    draw.constants_size = sizeof constants;
    draw.bindings = &binding;
    draw.binding_count = 1;
    lobe_pass_draw(pass, &draw);
}
