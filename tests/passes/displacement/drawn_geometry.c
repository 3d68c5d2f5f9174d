#include "tests/passes/displacement/drawn_geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/displacement/displacement.h"
#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

// ---------------------------------------------------------------------------------------------
// Scenes

lobe_image random_heights(uint32_t width, uint32_t height) {
    return random_map(width, height, 0, 1, 77);
}

lobe_image gaussian_heights(uint32_t texels, double slope, uint64_t seed, float *scale) {
    enum { WAVES = 60 };
    const int side = (int)texels, count = side * side;
    random_sequence sequence = scenes_random_start(seed);
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, texels, texels);
    double *heights = calloc((size_t)count, sizeof *heights), squares = 0;
    assert_non_null(heights);
    for (int w = 0; w < WAVES; w++) {
        const double size = exp(scenes_random_between(&sequence, log(3), log(40)));
        const double angle = scenes_random_between(&sequence, 0, 2 * M_PI);
        const double phase = scenes_random_between(&sequence, 0, 2 * M_PI);
        const int i = (int)lround(size * cos(angle)), j = (int)lround(size * sin(angle));
        for (int k = 0; k < count; k++)
            heights[k] += sin(2 * M_PI * (i * (k % side) + j * (k / side)) / side + phase) /
                          fmax(hypot(i, j), 1);
        squares += 2 * M_PI * M_PI; // of (2 pi size / size cos)
    }
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < count; k++) {
        low = fmin(low, heights[k]);
        high = fmax(high, heights[k]);
    }
    for (int k = 0; k < count; k++)
        ((float *)image.texels)[4 * k] = (float)((heights[k] - low) / (high - low));
    free(heights);
    *scale = (float)(slope / sqrt(squares / 2) * (high - low));
    return image;
}

void add_instance_of(lobe_scene *scene, lobe_mesh *mesh, const lobe_material *material,
                     const float transform[16]) {
    uint32_t mesh_index, material_index;
    assert_int_equal(scenes_add_mesh(scene, mesh, NULL, &mesh_index), LOBE_OK);
    assert_int_equal(scenes_add_material(scene, "relief", material, NULL, &material_index),
                     LOBE_OK);
    assert_int_equal(scenes_add_instance(scene, mesh_index, material_index, transform, NULL),
                     LOBE_OK);
}

lobe_material material_with_heights(lobe_scene *scene, lobe_image heights, float scale) {
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, 0);
    material.height_map = scene_add_map(scene, heights);
    material.height_scale = scale;
    return material;
}

/// `quads` x `quads` of one metre around the origin, with `tiles` of texture coordinates on each.
static lobe_mesh tiled_plane(uint32_t quads, float tiles) {
    lobe_mesh mesh;
    const uint32_t side = quads + 1;
    assert_int_equal(scenes_mesh_allocate(&mesh, "plane", side * side, 6 * quads * quads, NULL),
                     LOBE_OK);
    for (uint32_t i = 0; i < side * side; i++) {
        const float x = (float)(i % side), z = (float)(i / side);
        mesh.vertices[i] = (lobe_scene_vertex){
            .position = {x - 0.5f * (float)quads, 0, z - 0.5f * (float)quads},
            .normal = {0, 1, 0},
            .tangent = {1, 0, 0, 1},
            .texture_coordinates = {{tiles * x, tiles * z}},
            .colour = {1, 1, 1, 1},
        };
    }
    scenes_shape_grid_indices(quads, quads, mesh.indices);
    mesh.has_texture_coordinates[0] = true;
    scenes_mesh_compute_bounds(&mesh);
    return mesh;
}

lobe_scene *plane_with_heights(uint32_t quads, float tiles, lobe_image heights, float scale,
                               double seen) {
    lobe_scene *scene = scene_begin();
    const lobe_material material = material_with_heights(scene, heights, scale);
    lobe_mesh mesh = tiled_plane(quads, tiles);
    add_instance_of(scene, &mesh, &material, NULL);
    scene_look_down(scene, seen);
    scene_end(scene);
    return scene;
}

// ---------------------------------------------------------------------------------------------
// Geometry

static void *copy(const lobe_graph *graph, lobe_resource resource, size_t size) {
    size_t found = 0;
    const void *data = lobe_graph_data(graph, resource, &found);
    assert_non_null(data);
    assert_true(size <= found);
    void *result = malloc(size + 1);
    assert_non_null(result);
    return memcpy(result, data, size);
}

drawn_geometry displaced_geometry_of(fixture *f, const lobe_scene *scene, uint32_t extent,
                                     const char *spacing) {
    pass_run run;
    displacement *state = NULL;
    const char *assignments[] = {"displacement=geometry", spacing, NULL};
    pass_run_begin(&run, f, scene, "direct", assignments);
    run.context.view.width = run.context.view.height = extent;
    assert_int_equal(passes_displacement_prepare(&state, &run.context, run.scene), LOBE_OK);
    lobe_graph_begin(f->graph);
    passes_displacement(state, &run.context, run.scene, true);
    assert_non_null(run.scene->displaced);
    const displaced_geometry displaced = run.scene->displaced[0];
    const lobe_resource buffers[] = {displaced.vertices, displaced.indices, displaced.arguments};
    for (int i = 0; i < 3; i++)
        lobe_graph_read_back(f->graph, buffers[i], (lobe_range){0});
    pass_run_execute(&run);
    drawn_geometry g;
    memcpy(g.words, lobe_graph_data(f->graph, displaced.arguments, NULL), sizeof g.words);
    g.vertex_count = g.words[PATCH_TOTALS];
    g.triangle_count = g.words[PATCH_TOTALS + 1];
    assert_int_equal(g.words[PATCH_DRAW], 3 * g.triangle_count);
    const size_t size = g.vertex_count * sizeof *g.vertices, first = PATCH_FIRST_VERTEX;
    g.vertices = copy(f->graph, displaced.vertices, first * sizeof *g.vertices + size);
    memmove(g.vertices, g.vertices + first, size);
    g.indices = copy(f->graph, displaced.indices, g.triangle_count * 3 * sizeof *g.indices);
    for (uint32_t i = 0; i < 3 * g.triangle_count; i++)
        g.indices[i] -= PATCH_FIRST_VERTEX;
    lobe_graph_begin(f->graph);
    passes_displacement_destroy(&state);
    pass_run_end(&run);
    return g;
}

void drawn_geometry_free(drawn_geometry *g) {
    free(g->vertices);
    free(g->indices);
}
