#include "passes/displacement/patch_passes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "passes/context/camera.h"
#include "passes/context/knob_values.h"
#include "passes/context/shared_knobs.h"
#include "passes/upload/device_mesh.h"
#include "passes/upload/transform.h"
#include "shaders/interface/displacement/displacement.h"

/// Threads in a row of a dispatch: groups of 64, within every device's limits.
#define ROW (1u << 20)

/// Pixels outside of the picture that count as seen: samples of a pixel move the picture.
#define MARGIN 2

/// What one storage buffer holds on every device, over the size of a vertex.
enum {
    MOST_VERTICES = (1 << 27) / sizeof(lobe_scene_vertex) - PATCH_FIRST_VERTEX,
    MOST_TRIANGLES = 1 << 22
};

// ---------------------------------------------------------------------------------------------
// Constants

static void fill_transform(const float transform[16], struct displacement_constants *constants) {
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            constants->rows[row][column] = transform[4 * column + row];
}

/// The plane row[w] * factor + sign * row[axis] of a matrix.
static void fill_plane(mat4 matrix, int axis, double sign, double factor, float plane[4]) {
    double values[4], size = 0;
    for (int i = 0; i < 4; i++)
        values[i] = factor * (double)matrix[i][3] + sign * (double)matrix[i][axis];
    for (int i = 0; i < 3; i++)
        size += values[i] * values[i];
    size = sqrt(size);
    for (int i = 0; i < 4; i++)
        plane[i] = size > 0 ? (float)(values[i] / size) : (i == 3);
}

/// From where shadows may come into the picture. More lights than there is room for: from anywhere.
static void fill_casters(const filter_context *context, struct displacement_constants *constants) {
    const lobe_scene *scene = context->scene->scene;
    if (passes_knob_choice(context, &passes_knob_shadows) == 0)
        return;
    constants->caster_count = (uint32_t)scene->light_count;
    for (size_t i = 0; i < scene->light_count && i < PATCH_CASTERS; i++) {
        const lobe_light *light = &scene->lights[i];
        const bool far = light->type == LOBE_LIGHT_DIRECTIONAL;
        memcpy(constants->casters[i], far ? light->direction : light->position, 3 * sizeof(float));
        constants->casters[i][3] = far ? 0 : 1;
    }
}

/// Independent of the camera's jitter, so that this changes no vertex.
static void fill_camera(const filter_context *context, struct displacement_constants *constants) {
    static const float centre[2] = {0.5f, 0.5f};
    const filter_view *view = &context->view;
    const lobe_scene *scene = context->scene->scene;
    const float *jitter = view->camera->jitter;
    lobe_camera still = *view->camera;
    memset(still.jitter, 0, sizeof still.jitter);
    mat4 matrix;
    vec4 axis;
    passes_camera_projection(&still, view->width, view->height, centre, scene->minimum,
                             scene->maximum, matrix);
    passes_camera_axis(&still, axis);
    memcpy(constants->axis, axis, sizeof axis);
    const double margin =
        2 * (MARGIN + ceil(fmax(fabs((double)jitter[0]), fabs((double)jitter[1]))));
    for (int i = 0; i < 2; i++) {
        const double factor = 1 + margin / (i == 0 ? view->width : view->height);
        fill_plane(matrix, i, 1, factor, constants->planes[2 * i]);
        fill_plane(matrix, i, -1, factor, constants->planes[2 * i + 1]);
    }
    fill_plane(matrix, 2, -1, 1, constants->planes[4]); // near
    const double angle = view->camera->vertical_field_of_view;
    constants->perspective = angle > 0;
    constants->pixels = (float)(view->height / (angle > 0 ? 2 * tan(0.5 * angle)
                                                          : view->camera->orthographic_height));
    constants->near_plane = view->camera->near_plane;
    vec4 eye;
    passes_camera_eye(view->camera, eye);
    memcpy(constants->eye, eye, sizeof eye);
    fill_casters(context, constants);
}

/// Room for a surface that fills the picture: for each square of the spacing up to twelve triangles
/// and seven vertices, as in small patches, and four to five times that for what is seen at an
/// angle or outside; and some for shadows. Each patch has one triangle at least.
static void fill_room(const filter_context *context, const displaced_surface *surface,
                      struct displacement_constants *constants) {
    const double pixels = (double)context->view.width * context->view.height;
    const double squares = pixels / (surface->spacing * surface->spacing);
    const double least = constants->caster_count > 0 ? 16384 : 4096;
    const double patches = surface->layout->patches;
    constants->triangle_room = (uint32_t)fmax(least + fmin(60 * squares, MOST_TRIANGLES), patches);
    constants->vertex_room = (uint32_t)fmin(fmax(least + 28 * squares, 3 * patches), MOST_VERTICES);
}

static uint32_t wrap_of(lobe_scene_wrap wrap) {
    switch (wrap) {
    case LOBE_SCENE_WRAP_MIRROR:
        return WRAP_MIRROR;
    case LOBE_SCENE_WRAP_CLAMP:
        return WRAP_CLAMP;
    default:
        return WRAP_REPEAT;
    }
}

/// Which way fronts wind; 0: backs are seen, too.
static float facing_of(const filter_context *context, size_t instance) {
    const device_instance *own = &context->scene->instances[instance];
    const float *transform = context->scene->scene->instances[instance].transform;
    if (context->scene->scene->materials[own->material].double_sided)
        return 0;
    return passes_transform_determinant(transform) < 0 ? -1 : 1;
}

static struct displacement_constants constants_of(const filter_context *context,
                                                  const displaced_surface *surface) {
    const float *transform = context->scene->scene->instances[surface->instance].transform;
    const uint32_t patches = surface->layout->patches;
    struct displacement_constants constants = {
        .spacing = (float)surface->spacing,
        .relief = (float)surface->relief,
        .stretch = (float)passes_transform_stretch(transform),
        .scale = (float)cbrt(fabs(passes_transform_determinant(transform))),
        .facing = facing_of(context, surface->instance),
        .width = surface->width,
        .height = surface->height,
        .wrap_u = wrap_of(surface->use->wrap_u),
        .wrap_v = wrap_of(surface->use->wrap_v),
        .second_set = surface->use->texture_coordinates,
        .levels = surface->levels,
        .patch_count = patches,
        .depth = surface->layout->depth,
        .row = patches < ROW ? patches : ROW,
        .bounds_levels = surface->bounds.levels,
    };
    for (int row = 0; row < 2; row++)
        memcpy(constants.map_rows[row], surface->use->transform[row],
               sizeof surface->use->transform[row]);
    fill_transform(transform, &constants);
    fill_camera(context, &constants);
    fill_room(context, surface, &constants);
    return constants;
}

// ---------------------------------------------------------------------------------------------
// Passes

static lobe_resource declare(const filter_context *context, const char *what, size_t instance,
                             size_t size) {
    char name[64];
    snprintf(name, sizeof name, "%s of instance %zu", what, instance);
    return lobe_graph_buffer(
        context->graph, &(lobe_buffer_description){.name = name, .size = size, .retained = true});
}

static lobe_resource declare_vertices(const filter_context *context, const char *what,
                                      size_t instance, uint32_t room) {
    return declare(context, what, instance,
                   (PATCH_FIRST_VERTEX + (size_t)room) * sizeof(lobe_scene_vertex));
}

static patch_buffers declare_buffers(const filter_context *context, size_t instance,
                                     const struct displacement_constants *constants) {
    const size_t patches = constants->patch_count;
    return (patch_buffers){
        .constants =
            lobe_graph_upload(context->graph, "displacement", constants, sizeof *constants),
        .sizes = declare(context, "patch sizes", instance, patches * 4 * sizeof(float)),
        .bins = declare(context, "patch bins", instance, PATCH_BINS * sizeof(uint32_t)),
        .offsets = declare(context, "patch offsets", instance, patches * 2 * sizeof(uint32_t)),
        .arguments = declare(context, "patch arguments", instance, PATCH_WORDS * sizeof(uint32_t)),
        .vertices =
            declare_vertices(context, "displaced vertices", instance, constants->vertex_room),
        .triangles = declare(context, "displaced triangles", instance,
                             constants->triangle_room * 3 * sizeof(uint32_t)),
    };
}

static void read(lobe_pass *pass, const char *name, lobe_resource resource) {
    lobe_pass_read(pass, &(lobe_binding){.name = name, .resource = resource});
}

/// What passes that look at places on the mesh read. `points`: its pose.
static void read_mesh(const filter_context *context, const displaced_surface *surface,
                      const patch_buffers *buffers, lobe_resource points, lobe_pass *pass) {
    lobe_graph *graph = context->graph;
    const displaced_mesh *mesh = surface->mesh;
    const uint32_t index = context->scene->instances[surface->instance].mesh;
    read(pass, "displacement_block", buffers->constants);
    read(pass, "triangle_block", lobe_graph_import_buffer(graph, mesh->triangles));
    read(pass, "edge_block", lobe_graph_import_buffer(graph, mesh->edges));
    read(pass, "chart_block", lobe_graph_import_buffer(graph, mesh->charts));
    read(pass, "pair_block", lobe_graph_import_buffer(graph, mesh->pairs));
    read(pass, "point_block", points);
    read(pass, "vertex_block", passes_device_mesh_import(graph, context->scene, index));
}

static void read_heights(const filter_context *context, const displaced_surface *surface,
                         lobe_pass *pass) {
    read(pass, "base_point_block", lobe_graph_import_buffer(context->graph, surface->mesh->points));
    read(pass, "measure_block", surface->measures);
    read(pass, "height_map", surface->heights);
    read(pass, "height_levels", surface->height_levels);
}

static void measure_patches(const filter_context *context, const displaced_surface *surface,
                            uint32_t row, patch_buffers *buffers) {
    lobe_pass *clear = lobe_graph_add_pass(context->graph, LOBE_PASS_TRANSFER, "clear");
    buffers->bins = lobe_pass_fill(clear, buffers->bins, (lobe_range){0}, (float[4]){0});
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "patch_sizes");
    read_mesh(context, surface, buffers, surface->mesh->posed, pass);
    read_heights(context, surface, pass);
    read(pass, "bounds_block", surface->bounds.buffer);
    buffers->sizes =
        lobe_pass_write(pass, &(lobe_binding){.name = "patch_block", .resource = buffers->sizes});
    buffers->bins =
        lobe_pass_modify(pass, &(lobe_binding){.name = "bin_block", .resource = buffers->bins});
    lobe_pass_dispatch(
        pass, &(lobe_dispatch){.shader = "displacement/patch_sizes.comp",
                               .threads = {row, (surface->layout->patches - 1) / row + 1}});
}

static void place_patches(const filter_context *context, patch_buffers *buffers) {
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "patch_offsets");
    read(pass, "displacement_block", buffers->constants);
    read(pass, "patch_block", buffers->sizes);
    read(pass, "bin_block", buffers->bins);
    buffers->offsets = lobe_pass_write(
        pass, &(lobe_binding){.name = "offset_block", .resource = buffers->offsets});
    buffers->arguments = lobe_pass_write(
        pass, &(lobe_binding){.name = "argument_block", .resource = buffers->arguments});
    lobe_pass_dispatch(pass, &(lobe_dispatch){.shader = "displacement/patch_offsets.comp",
                                              .threads = {PATCH_GROUP, 1, 1}});
}

static void read_patches(const patch_buffers *buffers, lobe_pass *pass) {
    read(pass, "patch_block", buffers->sizes);
    read(pass, "offset_block", buffers->offsets);
    read(pass, "argument_block", buffers->arguments);
}

static lobe_resource write_vertices(const filter_context *context, const displaced_surface *surface,
                                    const patch_buffers *buffers, lobe_resource points,
                                    lobe_resource vertices) {
    lobe_graph *graph = context->graph;
    const uint32_t index = context->scene->instances[surface->instance].mesh;
    lobe_pass *pass = lobe_graph_add_pass(graph, LOBE_PASS_COMPUTE, "displaced_vertices");
    read_mesh(context, surface, buffers, points, pass);
    read_patches(buffers, pass);
    read_heights(context, surface, pass);
    read(pass, "index_block", lobe_graph_import_buffer(graph, context->scene->indices[index]));
    vertices =
        lobe_pass_write(pass, &(lobe_binding){.name = "displaced_block", .resource = vertices});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "displacement/displaced_vertices.comp",
                                        .indirect = buffers->arguments,
                                        .indirect_offset = PATCH_VERTICES * sizeof(uint32_t)});
    return vertices;
}

static void write_triangles(const filter_context *context, patch_buffers *buffers) {
    lobe_pass *pass = lobe_graph_add_pass(context->graph, LOBE_PASS_COMPUTE, "displaced_triangles");
    read(pass, "displacement_block", buffers->constants);
    read_patches(buffers, pass);
    buffers->triangles = lobe_pass_write(
        pass, &(lobe_binding){.name = "index_block", .resource = buffers->triangles});
    lobe_pass_dispatch(pass,
                       &(lobe_dispatch){.shader = "displacement/displaced_triangles.comp",
                                        .indirect = buffers->arguments,
                                        .indirect_offset = PATCH_TRIANGLES * sizeof(uint32_t)});
}

patch_buffers passes_displace_patches(const filter_context *context,
                                      const displaced_surface *surface) {
    const struct displacement_constants constants = constants_of(context, surface);
    patch_buffers buffers = declare_buffers(context, surface->instance, &constants);
    measure_patches(context, surface, constants.row, &buffers);
    place_patches(context, &buffers);
    buffers.vertices =
        write_vertices(context, surface, &buffers, surface->mesh->posed, buffers.vertices);
    write_triangles(context, &buffers);
    buffers.vertex_room = constants.vertex_room;
    return buffers;
}

lobe_resource passes_displace_before(const filter_context *context,
                                     const displaced_surface *surface,
                                     const patch_buffers *buffers) {
    return write_vertices(context, surface, buffers, surface->mesh->posed_before,
                          declare_vertices(context, "previous displaced vertices",
                                           surface->instance, buffers->vertex_room));
}
