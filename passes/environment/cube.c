#include "passes/environment/cube.h"

#include <math.h>

#include "passes/environment/reduction.h"
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

/// Lavapipe silently ends the loops of a shader after 65535 iterations in total. At the poles of an
/// image of latitude and longitude rows are short, so that each of a texel's points is a mean of
/// many columns.
#define MOST_ITERATIONS 60000
/// Texels along the square around a pole in which one invocation does not suffice, at most.
#define POLAR_WIDTH 16
/// Points along each axis of a texel, at most, but for the poles.
#define MOST_SUBSAMPLES 32
#define LARGEST_SIZE    2048

/// Of a texel at a pole (cube.glsl), at most. It has six times as many points along each axis, in a
/// lattice of up to 1.62 times as many. Each reads columns around it, more of them the smaller its
/// sine is: the mean of 1 / sine over the texel is 1.76 / extent.
static double polar_iterations(uint32_t subsamples, uint32_t columns) {
    const double side = 6 * fmax(subsamples, ENVIRONMENT_SUBSAMPLES), points = 1.62 * side * side;
    return points + 4 * 1.76 / (2 * M_PI) * columns * sqrt(points);
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
        if (polar_iterations(constants.subsamples, environment->image.width) > MOST_ITERATIONS)
            constants.polar_width = size < POLAR_WIDTH ? size : POLAR_WIDTH;
    } else if (texels % size == 0) {
        // Every texel of the cube covers whole texels of the image: their mean is exact.
        constants.nearest = 1;
        constants.subsamples = texels / size;
    } else {
        constants.subsamples = (uint32_t)ceil(ENVIRONMENT_SUBSAMPLES * (double)texels / size);
    }
    return constants;
}

/// What both passes read.
typedef struct cube_source {
    lobe_graph *graph;
    lobe_resource image, places;
    struct environment_cube_constants constants;
} cube_source;

static lobe_pass *add_pass(const cube_source *source, const char *name) {
    lobe_pass *pass = lobe_graph_add_pass(source->graph, LOBE_PASS_COMPUTE, name);
    lobe_pass_read(pass, &(lobe_binding){.name = "image",
                                         .resource = source->image,
                                         .sampler = {.texels = LOBE_SAMPLE_LINEAR,
                                                     .wrap_u = LOBE_WRAP_REPEAT,
                                                     .wrap_v = LOBE_WRAP_CLAMP}});
    lobe_pass_read(pass, &(lobe_binding){.name = "places_block", .resource = source->places});
    return pass;
}

static lobe_resource fill_cube(const cube_source *source, lobe_resource cube) {
    const uint32_t size = source->constants.size, polar = source->constants.polar_width;
    lobe_binding target = {"cube", cube, .range = {0, 1, 0, 6}};
    lobe_dispatch dispatch = {.shader = "environment/cube.comp",
                              .threads = {size, size, 6},
                              .constants = &source->constants,
                              .constants_size = sizeof source->constants};
    lobe_pass *pass = add_pass(source, "environment_cube");
    target.resource = lobe_pass_write(pass, &target);
    lobe_pass_dispatch(pass, &dispatch);
    if (polar == 0)
        return target.resource;
    pass = add_pass(source, "environment_poles");
    target.resource = lobe_pass_modify(pass, &target);
    dispatch.shader = "environment/poles.comp";
    dispatch.threads[0] = 2 * polar * polar * ENVIRONMENT_POLAR_GROUP_SIZE;
    dispatch.threads[1] = dispatch.threads[2] = 1;
    lobe_pass_dispatch(pass, &dispatch);
    return target.resource;
}

/// Of an image of many texels for each of the cube's: by way of a finer cube.
static lobe_resource reduce_finer_cube(const cube_source *source, lobe_resource cube,
                                       uint32_t size) {
    const uint32_t finer = source->constants.size;
    reduced_map map = {
        .width = finer, .height = finer, .layers = 6, .levels = passes_level_count(finer, finer)};
    map.resource = lobe_graph_image(source->graph,
                                    &(lobe_image_description){.name = "finer environment",
                                                              .format = LOBE_FORMAT_RGBA32_FLOAT,
                                                              .width = finer,
                                                              .height = finer,
                                                              .layers = 6,
                                                              .levels = map.levels});
    map.resource = fill_cube(source, map.resource);
    passes_environment_reduction(source->graph, &map);
    uint32_t level = 0;
    while (finer >> level > size)
        level++;
    lobe_pass *pass = lobe_graph_add_pass(source->graph, LOBE_PASS_TRANSFER, "environment_level");
    return lobe_pass_copy(pass, map.resource, (lobe_range){level, 1, 0, 6}, cube,
                          (lobe_range){0, 1, 0, 6});
}

lobe_resource passes_environment_cube(lobe_graph *graph, const lobe_environment *environment,
                                      const lobe_texture *texture, lobe_resource cube,
                                      uint32_t size) {
    struct environment_face_place places[6];
    for (int face = 0; face < 6; face++)
        places[face] = place_of_face(environment, face);
    cube_source source = {
        .graph = graph,
        .image = lobe_graph_import_texture(graph, texture),
        .places =
            lobe_graph_upload(graph, "places of faces on an environment", places, sizeof places),
        .constants = constants_of(environment, places, size),
    };
    for (uint32_t finer = 2 * size;
         source.constants.subsamples > MOST_SUBSAMPLES && finer <= LARGEST_SIZE; finer *= 2)
        source.constants = constants_of(environment, places, finer);
    return source.constants.size == size ? fill_cube(&source, cube)
                                         : reduce_finer_cube(&source, cube, size);
}
