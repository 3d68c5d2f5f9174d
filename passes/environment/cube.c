#include "passes/environment/cube.h"

#include <math.h>

#include "shaders/interface/environment/environment.h"

/// The centre of each face of the cube, and the directions of its x and y, as Vulkan defines them.
static const double face_axes[6][3][3] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

/// On the image, faces are rotated or mirrored squares: three points locate one.
static struct environment_face_place place_of_face(const lobe_environment *environment, int face) {
    double middle[2], ends[2][2];
    lobe_environment_position(environment, face_axes[face][0], middle);
    for (int axis = 0; axis < 2; axis++) {
        double direction[3];
        for (int i = 0; i < 3; i++)
            direction[i] = face_axes[face][0][i] + 0.5 * face_axes[face][1 + axis][i];
        lobe_environment_position(environment, direction, ends[axis]);
    }
    struct environment_face_place place = {.origin = {(float)middle[0], (float)middle[1]}};
    for (int i = 0; i < 4; i++)
        place.right_down[i] = (float)(2 * (ends[i / 2][i % 2] - middle[i % 2]));
    return place;
}

/// The width of a face on the image; 0 if the image does not consist of faces.
static uint32_t face_texels(const lobe_environment *environment,
                            const struct environment_face_place *place) {
    return environment->layout == LOBE_ENVIRONMENT_LATITUDE_LONGITUDE
               ? 0
               : (uint32_t)lround(2 * hypot(place->right_down[0], place->right_down[1]));
}

static struct environment_cube_constants constants_of(const lobe_environment *environment,
                                                      const struct environment_face_place *place,
                                                      uint32_t size) {
    uint32_t texels = face_texels(environment, place);
    struct environment_cube_constants constants = {.size = size, .face_texels = texels};
    if (texels == 0) {
        constants.latitude_longitude = 1;
        constants.face_texels = environment->image.height;
        // A texel in the middle of a face covers 2/size radians, a row of the image pi/height.
        constants.subsamples =
            (uint32_t)ceil(ENVIRONMENT_SUBSAMPLES * 2.0 / size * environment->image.height / M_PI);
    } else if (texels % size == 0) {
        // Every texel of the cube covers whole texels of the image: their mean is exact.
        constants.nearest = 1;
        constants.subsamples = texels / size;
    } else {
        constants.subsamples = (uint32_t)ceil(ENVIRONMENT_SUBSAMPLES * (double)texels / size);
    }
    return constants;
}

lobe_resource passes_environment_cube(lobe_graph *graph, const lobe_environment *environment,
                                      const lobe_texture *texture, lobe_resource cube,
                                      uint32_t size) {
    struct environment_face_place places[6];
    for (int face = 0; face < 6; face++)
        places[face] = place_of_face(environment, face);
    struct environment_cube_constants constants = constants_of(environment, places, size);
    lobe_resource uploaded =
        lobe_graph_upload(graph, "places of faces on an environment", places, sizeof places);
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "environment_cube");
    lobe_pass_read(pass, &(lobe_binding){.name = "image",
                                         .resource = lobe_graph_import_texture(graph, texture),
                                         .sampler = {.texels = LOBE_SAMPLE_LINEAR,
                                                     .wrap_u = LOBE_WRAP_REPEAT,
                                                     .wrap_v = LOBE_WRAP_CLAMP}});
    lobe_pass_read(pass, &(lobe_binding){.name = "places_block", .resource = uploaded});
    cube = lobe_pass_write(pass, &(lobe_binding){"cube", cube, .range = {0, 1, 0, 6}});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "environment/cube.comp",
                                              .threads = {size, size, 6},
                                              .constants = &constants,
                                              .constants_size = sizeof constants});
    return cube;
}
