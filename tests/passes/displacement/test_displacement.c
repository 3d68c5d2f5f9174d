// Displaced geometry: vertices are those of an independent formula, meshes stay closed, and a
// picture depends on nothing but the scene and the camera.

#include "passes/displacement/displacement.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/long_runs.h"

#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"
#include "tests/passes/displacement/drawn_geometry.h"
#include "tests/passes/support/picture.h"
#include "tests/passes/support/scene_builder.h"

// ---------------------------------------------------------------------------------------------
// Heights

enum { MAP = 64 };

/// Mean over a box of 2^level texels, wrapped.
static double box_mean(const lobe_image *map, int x, int y, int level) {
    const float *texels = map->texels;
    const int count = MAP >> level, size = 1 << level;
    double sum = 0;
    x = (x % count + count) % count;
    y = (y % count + count) % count;
    for (int j = 0; j < size; j++)
        for (int i = 0; i < size; i++)
            sum += texels[4 * ((y * size + j) * MAP + x * size + i)];
    return sum / (size * size);
}

static double bilinear(const lobe_image *map, double u, double v, int level) {
    const double x = u * (MAP >> level) - 0.5, y = v * (MAP >> level) - 0.5;
    const int i = (int)floor(x), j = (int)floor(y);
    const double s = x - i, t = y - j;
    return (1 - t) * ((1 - s) * box_mean(map, i, j, level) + s * box_mean(map, i + 1, j, level)) +
           t * ((1 - s) * box_mean(map, i, j + 1, level) + s * box_mean(map, i + 1, j + 1, level));
}

static double height_of(const lobe_image *map, const float uv[2], double level) {
    const int first = (int)level;
    return (1 - (level - first)) * bilinear(map, uv[0], uv[1], first) +
           (level - first) * bilinear(map, uv[0], uv[1], first + 1);
}

/// Rows and columns of a patch's vertex with even numbers that are on none of its edges have not
/// been moved.
static bool is_still(uint32_t number, uint32_t segments) {
    uint32_t row = 0;
    while ((row + 1) * (row + 2) / 2 <= number)
        ++row;
    const uint32_t column = number - row * (row + 1) / 2;
    return row % 2 == 0 && column % 2 == 0 && column > 0 && column < row && row < segments;
}

/// An orthographic camera sees `seen` metres of quads of one metre with two tiles of the map each.
static void check_heights(fixture *f, double seen, const char *spacing, double pixels,
                          uint32_t segments, double level) {
    enum { QUADS = 100, EXTENT = 64 };
    const float scale = -0.3f;
    lobe_scene *scene = plane_with_heights(QUADS, 2, random_heights(MAP, MAP), scale, seen);
    drawn_geometry g = displaced_geometry_of(f, scene, EXTENT, spacing);
    const uint32_t of_patch = (segments + 1) * (segments + 2) / 2;
    assert_int_equal(g.words[PATCH_SPACING], 0); // as close as asked for
    assert_true(g.vertex_count > 0);
    assert_int_equal(g.vertex_count % of_patch, 0);
    assert_int_equal(g.triangle_count / (segments * segments), g.vertex_count / of_patch);
    size_t checked = 0;
    for (uint32_t i = 0; i < g.vertex_count; i++) {
        const lobe_scene_vertex *vertex = &g.vertices[i];
        const double u = 2 * (vertex->position[0] + QUADS / 2);
        assert_float_equal(vertex->texture_coordinates[0][0], u, 2e-4);
        if (!is_still(i % of_patch, segments))
            continue;
        // A tile is half a metre wide.
        const double expected =
            scale * 0.5 * height_of(&scene->images[0].image, vertex->texture_coordinates[0], level);
        assert_float_equal(vertex->position[1], expected, 2e-4 * fabs((double)scale));
        ++checked;
    }
    assert_true(checked > 20);
    // Vertices are as close as asked for, or as a patch allows.
    assert_true(segments == 64 || EXTENT / seen / segments <= pixels * 1.001);
    drawn_geometry_free(&g);
    lobe_scene_destroy(&scene);
}

static void vertices_have_the_height_of_their_level(void **state) {
    fixture *f = *state;
    const double diagonal = 2 * MAP * sqrt(2.0);
    // Patches have 64 segments at most: level log2 of the texels between them.
    check_heights(f, 1.6, "pixels_per_vertex=0.5", 0.5, 64, log2(diagonal / 64));
    // 64 pixels show 3.2 m: 20 pixels a metre, 128 texels.
    check_heights(f, 3.2, "pixels_per_vertex=2", 2, 16, log2(2 * 128 / 20.0));
    check_heights(f, 3.2, "pixels_per_vertex=6", 6, 8, log2(6 * 128 / 20.0));
}

/// Where the largest edge of a patch alone has two segments, the patch is bent, and not level with
/// a wall above that edge.
static void no_triangle_is_a_wall(void **state) {
    fixture *f = *state;
    lobe_scene *scene = plane_with_heights(40, 1, random_heights(128, 128), 1, 10);
    drawn_geometry g = displaced_geometry_of(f, scene, 64, "pixels_per_vertex=1.75");
    assert_true(g.triangle_count > 0);
    assert_int_equal(7 * g.triangle_count, 6 * g.vertex_count);
    for (uint32_t i = 0; i < g.triangle_count; i++) {
        double edges[2][3], normal[3], square = 0;
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < 3; k++)
                edges[e][k] = (double)(g.vertices[g.indices[3 * i + 1 + (uint32_t)e]].position[k] -
                                       g.vertices[g.indices[3 * i]].position[k]);
        for (int k = 0; k < 3; k++) {
            normal[k] = edges[0][(k + 1) % 3] * edges[1][(k + 2) % 3] -
                        edges[0][(k + 2) % 3] * edges[1][(k + 1) % 3];
            square += normal[k] * normal[k];
        }
        assert_true(sqrt(square) < 1e-6 || fabs(normal[1]) > 0.5 * sqrt(square));
    }
    drawn_geometry_free(&g);
    lobe_scene_destroy(&scene);
}

/// Linear heights are the same on every level, and between all vertices.
static void a_ramp_is_a_ramp(void **state) {
    fixture *f = *state;
    lobe_image map = map_image(LOBE_FORMAT_RGBA32_FLOAT, 256, 256);
    for (int i = 0; i < 256 * 256; i++)
        ((float *)map.texels)[4 * i] = ((float)(i % 256) + 0.5f) / 256;
    lobe_scene *scene = plane_with_heights(1, 0.5f, map, 1, 1.1);
    for (int i = 0; i < 4; i++) // away from where the map repeats
        scene->meshes[0].vertices[i].texture_coordinates[0][0] += 0.25f;
    drawn_geometry g = displaced_geometry_of(f, scene, 200, "pixels_per_vertex=5.3");
    for (uint32_t i = 0; i < g.vertex_count; i++) {
        const double u = 0.25 + 0.5 * (g.vertices[i].position[0] + 0.5);
        assert_float_equal(g.vertices[i].position[1], 2 * u, 1e-5); // a tile is two metres wide
    }
    assert_true(g.vertex_count > 500);
    drawn_geometry_free(&g);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Cracks

typedef struct directed_edge {
    float from[3], to[3];
} directed_edge;

static int compare_places(const float *a, const float *b) {
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] < b[i] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b) {
    const directed_edge *first = a, *second = b;
    const int from = compare_places(first->from, second->from);
    return from ? from : compare_places(first->to, second->to);
}

/// Edges of triangles that have three places, in order; those of the opposite direction if
/// `reversed`.
static directed_edge *list_edges(const drawn_geometry *g, bool reversed, size_t *count) {
    directed_edge *edges = malloc(3 * (g->triangle_count + 1) * sizeof *edges);
    assert_non_null(edges);
    *count = 0;
    for (uint32_t i = 0; i < 3 * g->triangle_count; i++) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        const float *from = g->vertices[g->indices[reversed ? next : i]].position;
        const float *to = g->vertices[g->indices[reversed ? i : next]].position;
        if (compare_places(from, to) == 0)
            continue;
        directed_edge *edge = &edges[(*count)++];
        for (int k = 0; k < 3; k++) {
            edge->from[k] = from[k] + 0.0f;
            edge->to[k] = to[k] + 0.0f;
        }
    }
    qsort(edges, *count, sizeof *edges, compare_edges);
    return edges;
}

/// Each edge is there as often in one direction as in the other, to the bit: no crack, and no
/// vertex in the middle of an edge. (Of triangles without area both directions are there, too.)
static void assert_closed(const drawn_geometry *g) {
    size_t count, reversed_count;
    directed_edge *edges = list_edges(g, false, &count);
    directed_edge *reversed = list_edges(g, true, &reversed_count);
    assert_true(count > 300);
    for (size_t i = 0; i < count; i++)
        if (compare_edges(&edges[i], &reversed[i]) != 0)
            fail_msg("edge %zu of %zu is open", i, count);
    free(edges);
    free(reversed);
}

static lobe_scene *closed_scene(int kind, const float eye[3], const float transform[16]) {
    lobe_scene *scene = scene_begin();
    lobe_material material = material_with_heights(scene, random_heights(96, 40), 0.1f);
    if (kind == 2)
        material.height_map.wrap_u = LOBE_SCENE_WRAP_MIRROR;
    lobe_mesh mesh;
    if (kind == 0) // hard edges, and a seam at each of them
        assert_int_equal(scenes_shape_box((float[]){1, 1.3f, 0.7f}, 0.9f, NULL, &mesh), LOBE_OK);
    else // a seam, and triangles without area at the poles
        assert_int_equal(scenes_shape_sphere(8, 12, 3.2f, 1.7f, NULL, &mesh), LOBE_OK);
    add_instance_of(scene, &mesh, &material, transform);
    scene_add_sun(scene, (double[]){1, 2, 3}, 2);
    scene->camera =
        (lobe_camera){.up = {0, 1, 0}, .vertical_field_of_view = 2.2f, .near_plane = 0.01f};
    memcpy(scene->camera.eye, eye, sizeof scene->camera.eye);
    scene->has_camera = true;
    scene_end(scene);
    return scene;
}

static void closed_surfaces_stay_closed(void **state) {
    fixture *f = *state;
    static const float eyes[][3] = {{0, 0.3f, 1.6f}, {1.9f, 1, 0.2f}, {-0.3f, 2.5f, -0.1f}};
    static const char *const spacings[] = {"pixels_per_vertex=2", "pixels_per_vertex=3.3",
                                           "pixels_per_vertex=11"};
    for (int kind = 0; kind < 3; kind++) {
        for (int view = 0; view < 3; view++) {
            lobe_scene *scene = closed_scene(kind, eyes[view], NULL);
            scene->materials[0].double_sided = true; // or backs are left out
            drawn_geometry g = displaced_geometry_of(f, scene, 150, spacings[view]);
            assert_closed(&g);
            drawn_geometry_free(&g);
            lobe_scene_destroy(&scene);
        }
    }
}

// ---------------------------------------------------------------------------------------------
// Pictures

static const picture_request displaced_picture = {.filter = "direct",
                                                  .settings = {"displacement=geometry"},
                                                  .width = 96,
                                                  .height = 64,
                                                  .outputs = true};
static const picture_request flat_picture = {
    .filter = "direct", .width = 96, .height = 64, .outputs = true};

static double covered_pixels(const lobe_image *image) {
    double sum = 0;
    for (uint32_t i = 0; i < image->width * image->height; i++)
        sum += ((const float *)image->texels)[4 * i + 3];
    return sum;
}

/// Nothing of the background shines through a closed surface: all pixels inside of the outline of
/// the box, which is convex but for its relief, are covered.
static void nothing_shines_through(void **state) {
    fixture *f = *state;
    for (int kind = 0; kind < 2; kind++) {
        lobe_scene *scene = closed_scene(kind, (float[]){0.2f, 0.4f, 1.5f}, NULL);
        lobe_frame flat = draw_scene(f, scene, &flat_picture);
        lobe_frame displaced = draw_scene(f, scene, &displaced_picture);
        // The relief is outwards: what was covered still is.
        for (uint32_t i = 0; i < 96 * 64; i++) {
            const float *a = (const float *)flat.radiance.texels + 4 * i;
            const float *b = (const float *)displaced.radiance.texels + 4 * i;
            assert_true(a[3] <= b[3]);
        }
        assert_true(covered_pixels(&displaced.radiance) > 1.05 * covered_pixels(&flat.radiance));
        lobe_frame_free(&flat);
        lobe_frame_free(&displaced);
        lobe_scene_destroy(&scene);
    }
}

static void without_heights_nothing_is_displaced(void **state) {
    fixture *f = *state;
    lobe_scene *scene = closed_scene(1, (float[]){0.2f, 0.4f, 1.5f}, NULL);
    scene->materials[0].height_scale = 0;
    lobe_frame flat = draw_scene(f, scene, &flat_picture);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame displaced = draw_silently(f, scene->name, &displaced_picture);
    const lobe_graph_report *report = lobe_graph_describe(lobe_renderer_graph(f->renderer));
    for (size_t i = 0; i < report->pass_count; i++)
        assert_null(strstr(report->passes[i].name, "patch"));
    assert_true(largest_difference(&flat.radiance, &displaced.radiance) == 0);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_frame_free(&flat);
    lobe_frame_free(&displaced);
    lobe_scene_destroy(&scene);
}

static void double_factor_is_double_height(void **state) {
    fixture *f = *state;
    lobe_frame frames[2];
    for (int i = 0; i < 2; i++) {
        lobe_image map = random_heights(32, 32);
        for (int k = 0; k < 4 * 32 * 32; k++)
            ((float *)map.texels)[k] *= i == 0 ? 0.5f : 0.25f;
        lobe_scene *scene = plane_with_heights(3, 1, map, i == 0 ? 0.25f : 0.5f, 2);
        frames[i] = draw_scene(f, scene, &displaced_picture);
        lobe_scene_destroy(&scene);
    }
    assert_true(largest_difference(&frames[0].normal_depth, &frames[1].normal_depth) < 1e-6);
    lobe_frame_free(&frames[0]);
    lobe_frame_free(&frames[1]);
}

static void pictures_have_no_history(void **state) {
    fixture *f = *state;
    lobe_scene *scene = closed_scene(1, (float[]){0.2f, 0.4f, 1.9f}, NULL);
    const lobe_camera first = scene->camera;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    lobe_frame before = draw_silently(f, scene->name, &displaced_picture);
    // The same again makes nothing again.
    lobe_frame again = draw_silently(f, scene->name, &displaced_picture);
    lobe_graph *graph = lobe_renderer_graph(f->renderer);
    assert_int_equal(count_passes(graph, "displaced_vertices", LOBE_PASS_SKIPPED), 1);
    assert_int_equal(count_passes(graph, "patch_sizes", LOBE_PASS_SKIPPED), 1);
    scene->camera.eye[2] = 1.3f;
    lobe_frame near = draw_silently(f, scene->name, &displaced_picture);
    assert_int_equal(count_passes(graph, "displaced_vertices", LOBE_PASS_RUN), 1);
    assert_int_equal(count_passes(graph, "point_pose", LOBE_PASS_SKIPPED), 1);
    scene->camera = first;
    lobe_frame after = draw_silently(f, scene->name, &displaced_picture);
    assert_true(image_hash(&before.radiance) == image_hash(&after.radiance));
    assert_true(image_hash(&before.radiance) == image_hash(&again.radiance));
    assert_true(image_hash(&before.radiance) != image_hash(&near.radiance));
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_frame_free(&before);
    lobe_frame_free(&again);
    lobe_frame_free(&near);
    lobe_frame_free(&after);
    lobe_scene_destroy(&scene);
}

/// Depth where the surface is seen at an angle, at a spacing given in pixels.
static lobe_frame depths(fixture *f, const lobe_scene *scene, double spacing) {
    char text[64];
    snprintf(text, sizeof text, "pixels_per_vertex=%.9g", spacing);
    const picture_request request = {.filter = "direct",
                                     .settings = {"displacement=geometry", text},
                                     .width = 96,
                                     .height = 64,
                                     .outputs = true};
    return draw_scene(f, scene, &request);
}

static double largest_step(fixture *f, const lobe_scene *scene, double a, double b) {
    lobe_frame first = depths(f, scene, a), second = depths(f, scene, b);
    double largest = 0;
    for (uint32_t i = 0; i < 96 * 64; i++) {
        const float *p = (const float *)first.normal_depth.texels + 4 * i;
        const float *q = (const float *)second.normal_depth.texels + 4 * i;
        largest = fmax(largest, fabs((double)p[3] - q[3]));
    }
    lobe_frame_free(&first);
    lobe_frame_free(&second);
    return largest;
}

static void check_crossings(fixture *f, const lobe_scene *scene) {
    const double crossings[] = {8, 4, 8 / sqrt(2.0), 16 / sqrt(2.0)};
    for (int i = 0; i < 4; i++) {
        const double spacing = crossings[i];
        const double step = largest_step(f, scene, spacing * 1.00002, spacing * 0.99998);
        const double far_step = largest_step(f, scene, spacing * 1.2, spacing * 0.8);
        assert_true(far_step > 0.002);
        if (step > 0.002 * far_step)
            fail_msg("at %g pixels: a jump of %g; from 1.2 to 0.8 times that, %g", spacing, step,
                     far_step);
    }
}

/// Where numbers of segments double, surfaces do not jump. 64 pixels show 2 m of quads of 1 m; all
/// straight edges have a power of two of segments at spacings of 32 / 2^i pixels, diagonals at
/// those times sqrt(2). The second map has quads of eight patches: diagonals come to have four
/// segments while straight edges have two.
static void surfaces_do_not_jump(void **state) {
    lobe_scene *scenes[] = {plane_with_heights(3, 1, random_heights(32, 32), 0.4f, 2),
                            plane_with_heights(3, 0.5f, random_heights(128, 128), 0.4f, 2)};
    for (int i = 0; i < 2; i++) {
        check_crossings(*state, scenes[i]);
        lobe_scene_destroy(&scenes[i]);
    }
}

static void transforms_displace_outwards(void **state) {
    only_in_long_runs();
    fixture *f = *state;
    const float scales[][3] = {{1, 1, 1}, {-1, 1, 1}, {-1e-4f, 1e-4f, 1e-4f}, {1e4f, 1e4f, 1e4f}};
    double covered[4];
    for (int i = 0; i < 4; i++) {
        const float *s = scales[i], size = s[1];
        const float transform[16] = {s[0], 0, 0, 0, 0, s[1], 0, 0, 0, 0, s[2], 0, 0, 0, 0, 1};
        lobe_scene *scene = closed_scene(1, (float[]){0, 0.4f * size, 1.9f * size}, transform);
        scene->camera.near_plane = 0.01f * size;
        lobe_frame frame = draw_scene(f, scene, &displaced_picture);
        assert_true(all_finite(&frame.radiance));
        covered[i] = covered_pixels(&frame.radiance);
        lobe_frame_free(&frame);
        lobe_scene_destroy(&scene);
    }
    for (int i = 1; i < 4; i++)
        assert_float_equal(covered[i], covered[0], i == 1 ? 0.02 * covered[0] : 2);
}

/// Filters, samples of a pixel, motion and tiles all draw the displaced surface.
static void everything_draws_it(void **state) {
    fixture *f = *state;
    static const char *const settings[][4] = {{"displacement=geometry", "samples=auto"},
                                              {"displacement=geometry", "samples=4"},
                                              {"displacement=geometry", "built=seen"}};
    lobe_scene *scene = closed_scene(0, (float[]){0.2f, 0.4f, 1.5f}, NULL);
    scene->materials[0].normal_map = scene_add_map(scene, random_normal_map(64, 64, 0.4, 3));
    picture_request request = displaced_picture;
    request.filter = "leadr";
    lobe_frame one = draw_scene(f, scene, &request);
    for (int i = 0; i < 3; i++) {
        memcpy(request.settings, settings[i], sizeof settings[i]);
        lobe_frame frame = draw_scene(f, scene, &request);
        assert_float_equal(covered_pixels(&frame.radiance), covered_pixels(&one.radiance), 80);
        assert_true(relative_l2(&frame.radiance, &one.radiance) < 0.2);
        lobe_frame_free(&frame);
    }
    const lobe_filter *filter = filter_named("direct");
    const lobe_settings direct = settings_of(filter, displaced_picture.settings);
    lobe_frame moved;
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    assert_int_equal(lobe_renderer_render(f->renderer,
                                          &(lobe_render_parameters){.width = 96,
                                                                    .height = 64,
                                                                    .filter = filter,
                                                                    .settings = &direct,
                                                                    .motion.deliver = true},
                                          &moved),
                     LOBE_OK);
    for (uint32_t i = 0; i < 2 * 96 * 64; i++) // nothing moves
        assert_float_equal(((const float *)moved.motion.texels)[i], 0, 1e-3);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    lobe_frame_free(&moved);
    lobe_frame_free(&one);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Limits and bad input

/// Close to a plane, many more vertices are asked for than there is room for.
static lobe_scene *close_plane(float height) {
    lobe_scene *scene = plane_with_heights(60, 4, random_heights(64, 64), 0.01f, 1);
    scene->camera = (lobe_camera){.eye = {0, height, 0},
                                  .target = {1, 0.04f, 0},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 1,
                                  .near_plane = 0.001f};
    return scene;
}

/// Log2 of the distance of vertices over that which was asked for.
static double chosen_spacing(const drawn_geometry *g) {
    float spacing;
    memcpy(&spacing, &g->words[PATCH_SPACING], sizeof spacing);
    return (double)spacing;
}

static void geometry_has_a_limit(void **state) {
    fixture *f = *state;
    lobe_scene *scene = close_plane(0.05f);
    drawn_geometry g = displaced_geometry_of(f, scene, 64, "pixels_per_vertex=1");
    assert_true(chosen_spacing(&g) > 0);
    assert_true(g.vertex_count > 1000 && g.vertex_count <= 28 * 64 * 64 + 4096);
    assert_true(g.triangle_count <= 60 * 64 * 64 + 4096);
    for (uint32_t i = 0; i < 3 * g.triangle_count; i++)
        assert_true(g.indices[i] < g.vertex_count);
    drawn_geometry_free(&g);
    lobe_scene_destroy(&scene);
}

/// Nor does the distance of vertices jump where there is no room, while the camera climbs.
static void the_limit_does_not_jump(void **state) {
    only_in_long_runs();
    enum { STEPS = 15 };
    fixture *f = *state;
    double last = NAN;
    for (int i = 0; i <= STEPS; i++) {
        lobe_scene *scene = close_plane(0.5f * (float)exp2(0.04 * i));
        drawn_geometry g = displaced_geometry_of(f, scene, 64, "pixels_per_vertex=1");
        const double found = chosen_spacing(&g);
        assert_true(found > 0);
        if (fabs(found - last) > 0.2)
            fail_msg("after %d steps: 2^%g after 2^%g", i, found, last);
        last = found;
        drawn_geometry_free(&g);
        lobe_scene_destroy(&scene);
    }
}

/// Nor where patches that are as large as the picture enter and leave it.
static void the_limit_does_not_jump_with_patches(void **state) {
    enum { STEPS = 48 };
    fixture *f = *state;
    double last = NAN;
    lobe_scene *scene = plane_with_heights(8, 1, random_heights(64, 64), 0.02f, 1);
    for (int i = 0; i <= STEPS; i++) {
        const float x = 1.4f * (float)i / STEPS;
        scene->camera = (lobe_camera){.eye = {x, 0.3f, 0.37f * x},
                                      .target = {x + 0.3f, 0, 0.37f * x + 0.2f},
                                      .up = {0, 1, 0},
                                      .vertical_field_of_view = 0.9f,
                                      .near_plane = 0.01f};
        drawn_geometry g = displaced_geometry_of(f, scene, 64, "pixels_per_vertex=3");
        const double found = chosen_spacing(&g);
        assert_true(found > 0);
        assert_true(g.triangle_count <= 60 * 64 * 64 / 9 + 4096);
        if (fabs(found - last) > 0.12)
            fail_msg("after %d steps: 2^%g after 2^%g", i, found, last);
        last = found;
        drawn_geometry_free(&g);
    }
    lobe_scene_destroy(&scene);
}

static lobe_result try_drawing(fixture *f, const lobe_scene *scene) {
    const lobe_filter *filter = filter_named("direct");
    const lobe_settings settings = settings_of(filter, displaced_picture.settings);
    lobe_frame frame;
    fixture_forget_messages(f);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, scene), LOBE_OK);
    const lobe_result result = lobe_renderer_render(
        f->renderer,
        &(lobe_render_parameters){
            .width = 16, .height = 16, .filter = filter, .settings = &settings},
        &frame);
    if (result == LOBE_OK)
        assert_true(all_finite(&frame.radiance));
    lobe_frame_free(&frame);
    assert_int_equal(lobe_renderer_set_scene(f->renderer, NULL), LOBE_OK);
    return result;
}

static void heights_are_numbers(void **state) {
    fixture *f = *state;
    lobe_scene *scene = plane_with_heights(1, 1, random_heights(8, 8), 0.1f, 1);
    ((float *)scene->images[0].image.texels)[20] = NAN;
    // Without a normal map, heights are needed earlier (tests/passes/upload/test_height_normals.c).
    scene->materials[0].normal_map = scene_add_map(scene, constant_map(1, 1, 0.5f, 0.5f, 1));
    assert_failure(f, try_drawing(f, scene), LOBE_ERROR_MALFORMED, "map");
    // Nobody reads heights where nothing is displaced.
    lobe_frame frame =
        draw_scene(f, scene, &(picture_request){.filter = "direct", .width = 16, .height = 16});
    assert_true(all_finite(&frame.radiance));
    lobe_frame_free(&frame);
    lobe_scene_destroy(&scene);
}

/// One warning says why; the rest is drawn.
static void what_cannot_be_displaced_is_drawn(void **state) {
    fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        lobe_scene *scene = plane_with_heights(2, 1, random_heights(8, 8), 0.1f, 1);
        lobe_mesh *mesh = &scene->meshes[0];
        if (i == 0)
            mesh->has_texture_coordinates[0] = false;
        for (size_t k = 0; i == 1 && k < mesh->vertex_count; k++)
            memset(mesh->vertices[k].texture_coordinates, 0,
                   sizeof mesh->vertices[k].texture_coordinates);
        if (i == 2)
            scene->materials[0].height_scale = 1e38f;
        if (i == 3) {
            const size_t count = 3 * ((1 << 19) + 1);
            uint32_t *indices = lobe_allocate(NULL, count, sizeof *indices);
            for (size_t k = 0; k < count; k++)
                indices[k] = mesh->indices[k % mesh->index_count];
            lobe_release(mesh->indices);
            mesh->indices = indices;
            mesh->index_count = count;
        }
        assert_int_equal(try_drawing(f, scene), LOBE_OK);
        assert_int_equal(f->warnings, 1);
        assert_int_equal(f->errors, 0);
        lobe_scene_destroy(&scene);
    }
}

static void odd_maps_and_triangles_are_drawn(void **state) {
    fixture *f = *state;
    static const uint32_t sizes[][2] = {{1, 1}, {1, 7}, {300, 1}, {5, 3}};
    for (int i = 0; i < 4; i++) {
        lobe_scene *scene = plane_with_heights(2, 1.7f, random_heights(sizes[i][0], sizes[i][1]),
                                               i % 2 ? 0.1f : -0.1f, 1);
        scene->materials[0].height_map.wrap_u = (lobe_scene_wrap)(i % 3);
        scene->materials[0].height_map.wrap_v = (lobe_scene_wrap)((i + 1) % 3);
        scene->meshes[0].indices[1] = scene->meshes[0].indices[0];
        scene->meshes[0].vertices[4].texture_coordinates[0][0] = 3e30f;
        assert_int_equal(try_drawing(f, scene), LOBE_OK);
        assert_int_equal(f->errors, 0);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_have_the_height_of_their_level),
        cmocka_unit_test(no_triangle_is_a_wall),
        cmocka_unit_test(a_ramp_is_a_ramp),
        cmocka_unit_test(closed_surfaces_stay_closed),
        cmocka_unit_test(nothing_shines_through),
        cmocka_unit_test(without_heights_nothing_is_displaced),
        cmocka_unit_test(double_factor_is_double_height),
        cmocka_unit_test(pictures_have_no_history),
        cmocka_unit_test(surfaces_do_not_jump),
        cmocka_unit_test(transforms_displace_outwards),
        cmocka_unit_test(everything_draws_it),
        cmocka_unit_test(geometry_has_a_limit),
        cmocka_unit_test(the_limit_does_not_jump),
        cmocka_unit_test(the_limit_does_not_jump_with_patches),
        cmocka_unit_test(heights_are_numbers),
        cmocka_unit_test(what_cannot_be_displaced_is_drawn),
        cmocka_unit_test(odd_maps_and_triangles_are_drawn),
    };
    return cmocka_run_group_tests(tests, fixture_create_validated, fixture_destroy);
}
