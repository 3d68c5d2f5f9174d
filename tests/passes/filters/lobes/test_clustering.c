// Clusters of lobes against the sums of their texels' characteristic vectors in double precision:
// in tangent space, and over a mesh's atlas in object and camera space.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "passes/filters/lobes/clustering.h"
#include "shaders/interface/cluster.h"
#include "tests/passes/support/mixture_reference.h"
#include "tests/passes/support/pass_run.h"
#include "tests/passes/support/scene_builder.h"
#include "tests/reference/lobe/lobe_cluster.h"
#include "tests/reference/lobe/von_mises_fisher.h"
#include "tests/reference/map/box_reduction.h"
#include "tests/reference/mixture/lobe_mixture.h"

/// The request to lobe_clustering.
typedef struct request {
    lobe_map_space space;
    uint32_t subdivision;
    bool mean;
    bool half_floats;
    bool as_in_paper;
} request;

/// The result.
typedef struct clusters {
    mixture_map mixture;
    float *texels; ///< all levels
} clusters;

/// Clusters instance 0 of a scene, and reduces.
static clusters cluster(fixture *f, const lobe_scene *scene, const request *asked) {
    pass_run run;
    pass_run_begin(
        &run, f, scene, "lobes",
        (const char *[]){asked->half_floats ? "storage=float16" : "storage=float32", NULL});
    const mixture_request wanted = {.space = asked->space,
                                    .subdivision = asked->subdivision,
                                    .clusters =
                                        asked->as_in_paper ? CLUSTERS_PAPER : CLUSTERS_TURNED,
                                    .mean = asked->mean};
    clusters result = {.mixture = passes_lobe_clustering(&run.context, 0, &wanted)};
    passes_level_reduction(f->graph, &result.mixture.map);
    result.texels = pass_run_read(&run, &result.mixture.map, result.mixture.format);
    pass_run_end(&run);
    return result;
}

/// One layer of a texel: r and w add up to at most one each, errors are a few roundings.
static void check_texel(const float *texel, const double *exact, bool mean, double tolerance,
                        const char *where) {
    for (int i = 0; i < 4; i++) {
        // The mean of 1 - |r| may be tiny, but must still be accurate.
        double bound = mean && i == 3 ? 10 * tolerance * exact[i] + 1e-9 : tolerance;
        if (!(fabs((double)texel[i] - exact[i]) <= bound))
            fail_msg("%s, channel %d: %.9g instead of %.9g", where, i, (double)texel[i], exact[i]);
    }
}

/// Compares level 0 of a mixture map, of half the maps' size, and all that follow.
static void check_clusters(const fixture *f, const clusters *found, const reference_layers *texels,
                           double tolerance) {
    const mixture_map *mixture = &found->mixture;
    fixture_need_exact_sampler(f);
    reference_layers exact = reference_reduce(texels);
    const float *texel = found->texels;
    assert_int_equal(mixture->map.width, exact.width);
    assert_int_equal(mixture->map.height, exact.height);
    for (uint32_t level = 0; level < mixture->map.levels; level++) {
        for (uint32_t layer = 0; layer < mixture->map.layers; layer++) {
            uint32_t source = mixture_reference_layer(mixture, layer);
            for (uint32_t i = 0; i < exact.width * exact.height; i++, texel += 4) {
                char where[96];
                uint32_t x = i % exact.width, y = i / exact.width;
                snprintf(where, sizeof where, "level %u of %ux%u, layer %u, texel %u, %u", level,
                         texels->width, texels->height, layer, x, y);
                check_texel(texel, reference_texel(&exact, x, y, source),
                            source == REFERENCE_MIXTURE_LAYER_MEAN, tolerance, where);
            }
        }
        reference_layers next = reference_reduce(&exact);
        reference_layers_free(&exact);
        exact = next;
    }
    reference_layers_free(&exact);
}

static void check_tangent_space(fixture *f, lobe_scene *scene, const request *asked) {
    clusters found = cluster(f, scene, asked);
    uint32_t layers = (asked->subdivision == 0   ? 1
                       : asked->subdivision == 1 ? 5
                                                 : 13) +
                      (asked->mean ? 1 : 0);
    assert_int_equal(found.mixture.map.layers, layers);
    reference_layers texels = mixture_of_texels(scene, &scene->materials[0], NULL, NULL);
    // Texture coordinates have 24 bits, those of a large map's texels fewer.
    check_clusters(f, &found, &texels, asked->half_floats ? 1e-3 : 3e-6 + 4e-8 * texels.width);
    reference_layers_free(&texels);
    free(found.texels);
}

static lobe_scene *square_of(const lobe_material *material, lobe_scene *scene) {
    scene_end_with_square(scene, material);
    return scene;
}

static lobe_material two_lobes(void) {
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 128);
    material.lobe_count = 2;
    material.lobes[0] = (lobe_base_lobe){{0.6f, 0, 0.8f}, 128, {0.5f, 0.25f, 0.125f}};
    material.lobes[1] = (lobe_base_lobe){{-0.6f, 0, 0.8f}, 30, {0.1f, 0.2f, 0.3f}};
    return material;
}

static void odd_sizes_are_clustered_exactly(void **state) {
    static const uint32_t sizes[][2] = {{1, 1},  {1, 7},   {7, 1},  {2, 2},
                                        {16, 8}, {67, 45}, {40, 24}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 200);
        material.normal_map =
            scene_add_map(scene, random_normal_map(sizes[i][0], sizes[i][1], 1.0, i + 1));
        square_of(&material, scene);
        check_tangent_space(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, true, false, false});
        lobe_scene_destroy(&scene);
    }
}

static void a_large_odd_map_is_clustered_exactly(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = two_lobes();
    material.normal_map = scene_add_map(scene, random_normal_map(671, 457, 0.4, 3));
    square_of(&material, scene);
    check_tangent_space(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, false, false, false});
    lobe_scene_destroy(&scene);
}

/// Every subdivision, with the mean layer and without, for both models of material.
static void what_is_asked_for_is_stored(void **state) {
    for (int model = 0; model < 2; model++) {
        lobe_scene *scene = scene_begin();
        lobe_material material = two_lobes();
        if (model == 0)
            lobe_material_default(&material);
        material.roughness = 0.4f;
        material.normal_map = scene_add_map(scene, random_normal_map(13, 10, 0.7, 5));
        square_of(&material, scene);
        for (uint32_t subdivision = 0; subdivision <= 2; subdivision++) {
            for (int mean = 0; mean < 2; mean++)
                check_tangent_space(
                    *state, scene, &(request){LOBE_SPACE_TANGENT, subdivision, mean, false, false});
        }
        check_tangent_space(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, true, true, false});
        lobe_scene_destroy(&scene);
    }
}

/// Every distribution, with normals that vary inside a texel, and maps of different sizes, neither
/// of which is larger in both directions.
static void widths_are_convolved_and_mapped(void **state) {
    static const lobe_distribution distributions[] = {
        LOBE_DISTRIBUTION_GGX, LOBE_DISTRIBUTION_BECKMANN, LOBE_DISTRIBUTION_BLINN_PHONG,
        LOBE_DISTRIBUTION_VMF};
    for (size_t i = 0; i < 8; i++) {
        lobe_distribution distribution = distributions[i % 4];
        bool microfacet = i < 4;
        if (!microfacet && i % 4 < 2)
            continue; // half-vector lobes are Blinn-Phong or von Mises-Fisher
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(distribution, 50);
        if (microfacet)
            lobe_material_default(&material);
        material.distribution = distribution;
        material.normal_concentration = 60;
        material.normal_scale = 0.5f;
        material.normal_map = scene_add_map(scene, random_normal_map(24, 6, 0.8, 7 + i));
        lobe_texture_use widths =
            scene_add_map(scene, random_map(9, 12, microfacet ? 0.1 : 0.5, microfacet ? 1 : 4, i));
        if (microfacet)
            material.metallic_roughness_map = widths;
        else
            material.width_map = widths;
        square_of(&material, scene);
        check_tangent_space(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, true, false, false});
        lobe_scene_destroy(&scene);
    }
}

/// The paper's clusters: each direction is in the one where the reference has it.
static void directions_are_divided_as_in_the_paper(void **state) {
    for (int i = 0; i < 8; i++) {
        const double azimuth = (20 + 45 * i) * M_PI / 180, tilt = (i % 2 ? 55 : 30) * M_PI / 180;
        const double axis[3] = {sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt)};
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 50);
        material.normal_map = scene_add_map(scene, constant_map(2, 2, (float)(0.5 + 0.5 * axis[0]),
                                                                (float)(0.5 + 0.5 * axis[1]),
                                                                (float)(0.5 + 0.5 * axis[2])));
        square_of(&material, scene);
        clusters found =
            cluster(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, false, false, true});
        const uint32_t expected = reference_cluster_of(axis, true);
        for (uint32_t k = 0; k < 8; k++)
            assert_true(fabs((double)found.texels[4 * (5 + k) + 3] - (k == expected)) < 1e-6);
        free(found.texels);
        lobe_scene_destroy(&scene);
    }
}

static void eight_bit_normals_are_decoded(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_image image = map_image(LOBE_FORMAT_RGBA8_UNORM, 5, 5);
    uint8_t *bytes = image.texels;
    for (int i = 0; i < 100; i++)
        bytes[i] = (uint8_t)(i % 4 == 2 ? 200 + i % 50 : 90 + (i * 37) % 70);
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_BLINN_PHONG, 300);
    material.normal_map = scene_add_map(scene, image);
    material.normal_map.nearest = true; // some devices interpolate eight bits with eight bits
    square_of(&material, scene);
    check_tangent_space(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, true, false, false});
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Each subdivision is a distribution

/// The lobe that shading makes of a texel (sum of r, weight): Xu et al. 2017, Eq. 15.
typedef struct weighted_lobe {
    double weight, concentration, mean[3];
} weighted_lobe;

static weighted_lobe lobe_of(const double texel[4]) {
    weighted_lobe lobe = {.weight = texel[3], .mean = {0, 0, 1}};
    double length = sqrt(texel[0] * texel[0] + texel[1] * texel[1] + texel[2] * texel[2]);
    if (lobe.weight <= 0)
        return lobe;
    for (int i = 0; i < 3 && length > 0; i++)
        lobe.mean[i] = texel[i] / length;
    lobe.concentration =
        reference_concentration_from_complement(fmax(1 - length / lobe.weight, 1e-6));
    return lobe;
}

/// By a product of the midpoint rules in the cosine and the longitude about the z axis.
static double integral_over_sphere(const weighted_lobe *lobes, uint32_t count) {
    enum { ROWS = 300, COLUMNS = 120 };
    double sum = 0;
    for (int i = 0; i < ROWS; i++) {
        double cosine = 1 - 2 * (i + 0.5) / ROWS, sine = sqrt(1 - cosine * cosine);
        for (int j = 0; j < COLUMNS; j++) {
            double longitude = 2 * M_PI * (j + 0.5) / COLUMNS;
            const double direction[3] = {sine * cos(longitude), sine * sin(longitude), cosine};
            for (uint32_t k = 0; k < count; k++)
                sum += lobes[k].weight *
                       reference_von_mises_fisher(direction, lobes[k].mean, lobes[k].concentration);
        }
    }
    return sum * 4 * M_PI / (ROWS * COLUMNS);
}

/// At every level and for every subdivision: weights add up to the coverage, which is one, no
/// vector is longer than its weight, and what the shader makes of them integrates to one.
static void every_level_integrates_to_one(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = two_lobes();
    material.lobes[0].width = 60;
    material.normal_map = scene_add_map(scene, random_normal_map(23, 17, 0.9, 11));
    square_of(&material, scene);
    clusters found = cluster(*state, scene, &(request){LOBE_SPACE_TANGENT, 2, true, false, false});
    static const uint32_t first[] = {0, 1, 5}, count[] = {1, 4, 8};
    const reduced_map *map = &found.mixture.map;
    const float *level_texels = found.texels;
    uint32_t width = map->width, height = map->height;
    for (uint32_t level = 0; level < map->levels; level++) {
        reference_layers layers =
            reference_layers_allocate(width, height, REFERENCE_MIXTURE_LAYERS);
        for (size_t i = 0; i < (size_t)4 * width * height * map->layers; i++)
            layers.texels[i] = (double)level_texels[i];
        for (uint32_t subdivision = 0; subdivision <= 2; subdivision++) {
            for (uint32_t i = 0; i < width * height; i++) {
                double weights = 0;
                for (uint32_t j = 0; j < count[subdivision]; j++) {
                    const double *t =
                        reference_texel(&layers, i % width, i / width, first[subdivision] + j);
                    double length = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
                    assert_true(t[3] >= 0 && length <= t[3] + 1e-6);
                    weights += t[3];
                }
                assert_true(fabs(weights - 1) < 1e-5);
            }
            weighted_lobe lobes[8];
            for (uint32_t j = 0; j < count[subdivision]; j++)
                lobes[j] = lobe_of(
                    reference_texel(&layers, width / 2, height / 2, first[subdivision] + j));
            double integral = integral_over_sphere(lobes, count[subdivision]);
            if (!(fabs(integral - 1) < 2e-3))
                fail_msg("level %u, subdivision %u: %g", level, subdivision, integral);
        }
        level_texels += (size_t)4 * width * height * map->layers;
        width = passes_half_extent(width);
        height = passes_half_extent(height);
        reference_layers_free(&layers);
    }
    free(found.texels);
    lobe_scene_destroy(&scene);
}

// ---------------------------------------------------------------------------------------------
// Object and camera space

/// A rotation as its columns, and the part of the atlas that is covered.
typedef struct patch {
    double columns[3][3];
    double low[2], high[2];
} patch;

static bool patch_frame(const void *user, double u, double v, double frame[3][3]) {
    const patch *p = user;
    if (u < p->low[0] || u > p->high[0] || v < p->low[1] || v > p->high[1])
        return false;
    memcpy(frame, p->columns, sizeof p->columns);
    return true;
}

/// Columns of the rotation about an axis.
static void rotation_about(const double axis[3], double angle, double columns[3][3]) {
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    double k[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
    double c = cos(angle), s = sin(angle);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            columns[column][row] = (row == column ? c : 0) + (1 - c) * k[row] * k[column];
    }
    columns[0][1] += s * k[2];
    columns[0][2] -= s * k[1];
    columns[1][2] += s * k[0];
    columns[1][0] -= s * k[2];
    columns[2][0] += s * k[1];
    columns[2][1] -= s * k[0];
}

static void matrix_from(double columns[3][3], double scale, float transform[16]) {
    memset(transform, 0, 16 * sizeof *transform);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            transform[4 * column + row] = (float)(scale * columns[column][row]);
    }
    transform[12] = 0.25f;
    transform[13] = -0.5f;
    transform[14] = 0.125f;
    transform[15] = 1;
}

/// Tangent, bitangent and normal of scene_add_square.
static const double square_frame[3][3] = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

/// frame = rotation * square_frame
static void turn_square(double rotation[3][3], double frame[3][3]) {
    for (int axis = 0; axis < 3; axis++) {
        for (int row = 0; row < 3; row++) {
            frame[axis][row] = 0;
            for (int i = 0; i < 3; i++)
                frame[axis][row] += rotation[i][row] * square_frame[axis][i];
        }
    }
}

/// In object space a rotated square has the lobes of tangent space, rotated by the mesh's own
/// frame, wherever the instance is.
static void object_space_is_tangent_space_turned(void **state) {
    const double axis[3] = {1, -2, 0.5};
    double rotation[3][3];
    float transform[16];
    rotation_about(axis, 1.1, rotation);
    matrix_from(rotation, 3, transform);
    lobe_scene *scene = scene_begin();
    lobe_material material = two_lobes();
    material.normal_map = scene_add_map(scene, random_normal_map(15, 22, 0.5, 21));
    scene_add_square(scene, &material, 1, transform);
    scene_look_down(scene, 2);
    scene_end(scene);
    clusters found = cluster(*state, scene, &(request){LOBE_SPACE_OBJECT, 2, true, false, false});
    patch p = {.low = {0, 0}, .high = {1, 1}};
    memcpy(p.columns, square_frame, sizeof p.columns);
    reference_layers texels = mixture_of_texels(scene, &scene->materials[0], patch_frame, &p);
    check_clusters(*state, &found, &texels, 3e-6);
    reference_layers_free(&texels);
    free(found.texels);
    lobe_scene_destroy(&scene);
}

/// In camera space the instance's and the camera's rotations are added; scale and position have no
/// effect.
static void camera_space_is_tangent_space_turned(void **state) {
    for (int perspective = 0; perspective < 2; perspective++) {
        const double axis[3] = {0.3, 0.2, -1};
        double rotation[3][3], seen[3][3];
        float transform[16];
        rotation_about(axis, 0.6, rotation);
        matrix_from(rotation, 0.5, transform);
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 90);
        material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 22));
        scene_add_square(scene, &material, 1, transform);
        scene_look_down(scene, 2);
        scene->camera.vertical_field_of_view = perspective ? 0.8f : 0;
        scene_end(scene);
        clusters found =
            cluster(*state, scene, &(request){LOBE_SPACE_CAMERA, 2, true, false, false});
        patch p = {.low = {0, 0}, .high = {1, 1}};
        turn_square(rotation, seen);
        // The camera looks down: its axes are (+X, -Z, +Y) of the world.
        for (int i = 0; i < 3; i++) {
            p.columns[i][0] = seen[i][0];
            p.columns[i][1] = -seen[i][2];
            p.columns[i][2] = seen[i][1];
        }
        reference_layers texels = mixture_of_texels(scene, &scene->materials[0], patch_frame, &p);
        check_clusters(*state, &found, &texels, 4e-6);
        reference_layers_free(&texels);
        free(found.texels);
        lobe_scene_destroy(&scene);
    }
}

/// Moves the texture coordinates of a square's mesh into a part of the atlas.
static void shrink_coordinates(lobe_mesh *mesh, const patch *p) {
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        float *uv = mesh->vertices[i].texture_coordinates[0];
        for (int axis = 0; axis < 2; axis++)
            uv[axis] = (float)(p->low[axis] + uv[axis] * (p->high[axis] - p->low[axis]));
    }
}

/// Texels that no triangle covers have no lobes and no weight, at any level.
static void an_uncovered_atlas_has_no_weight(void **state) {
    lobe_scene *scene = scene_begin();
    lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 90);
    material.normal_map = scene_add_map(scene, random_normal_map(16, 16, 0.5, 23));
    scene_add_square(scene, &material, 1, NULL);
    // Columns 3 to 10, rows 0 to 12: edges of half a texel of the mixture.
    patch p = {.low = {3 / 16.0, 0}, .high = {11 / 16.0, 13 / 16.0}};
    memcpy(p.columns, square_frame, sizeof p.columns);
    shrink_coordinates(&scene->meshes[0], &p);
    scene_look_down(scene, 2);
    scene_end(scene);
    clusters found = cluster(*state, scene, &(request){LOBE_SPACE_OBJECT, 2, true, false, false});
    reference_layers texels = mixture_of_texels(scene, &scene->materials[0], patch_frame, &p);
    check_clusters(*state, &found, &texels, 3e-6);
    double covered = 8.0 * 13 / 256;
    const float *last =
        found.texels +
        passes_reduced_map_bytes(&found.mixture.map, LOBE_FORMAT_RGBA32_FLOAT) / sizeof(float) -
        (size_t)4 * found.mixture.map.layers;
    assert_true(fabs((double)last[3] - covered) < 1e-6);
    reference_layers_free(&texels);
    free(found.texels);
    lobe_scene_destroy(&scene);
}

/// One mesh of two squares back to back: the first faces up and has the left of the atlas, the
/// second faces down and has the right.
static void add_back_to_back(lobe_scene *scene, const lobe_material *material) {
    scene_add_square(scene, material, 1, NULL);
    lobe_mesh *mesh = &scene->meshes[0];
    lobe_scene_vertex *vertices = lobe_reallocate(NULL, mesh->vertices, 8, sizeof *vertices);
    uint32_t *indices = lobe_reallocate(NULL, mesh->indices, 12, sizeof *indices);
    assert_non_null(vertices);
    assert_non_null(indices);
    for (uint32_t i = 0; i < 4; i++) {
        lobe_scene_vertex *back = &vertices[4 + i];
        *back = vertices[i];
        back->normal[1] = -1;
        // Seen from below the image is mirrored.
        back->tangent[3] = -1;
        vertices[i].texture_coordinates[0][0] *= 0.5f;
        back->texture_coordinates[0][0] = 0.5f + 0.5f * back->texture_coordinates[0][0];
    }
    for (uint32_t i = 0; i < 6; i++)
        indices[6 + i] = 4 + indices[5 - i];
    mesh->vertices = vertices;
    mesh->indices = indices;
    mesh->vertex_count = 8;
    mesh->index_count = 12;
}

/// Weight of the coarsest two texels of a map twice as wide as high: left and right half.
static void halves_of_atlas(const clusters *found, double weights[2]) {
    const reduced_map *map = &found->mixture.map;
    const float *texel = found->texels;
    uint32_t width = map->width, height = map->height;
    for (; width > 2; width /= 2, height /= 2)
        texel += (size_t)4 * width * height * map->layers;
    assert_int_equal(height, 1);
    weights[0] = (double)texel[3];
    weights[1] = (double)texel[7];
}

static void back_faces_are_left_out_in_camera_space(void **state) {
    for (int i = 0; i < 4; i++) {
        bool below = i & 1, perspective = i & 2;
        lobe_scene *scene = scene_begin();
        lobe_material material = half_vector_material(LOBE_DISTRIBUTION_VMF, 90);
        material.normal_map = scene_add_map(scene, random_normal_map(32, 16, 0.5, 24));
        add_back_to_back(scene, &material);
        scene_look_from(scene, (double[]){0.1, below ? -1 : 1, 0.2}, 2);
        scene->camera.vertical_field_of_view = perspective ? 0.8f : 0;
        scene_end(scene);
        double weights[2];
        clusters found =
            cluster(*state, scene, &(request){LOBE_SPACE_CAMERA, 0, false, false, false});
        halves_of_atlas(&found, weights);
        assert_true(weights[below] > 0.9999 && weights[!below] == 0);
        free(found.texels);
        // Object space keeps both.
        found = cluster(*state, scene, &(request){LOBE_SPACE_OBJECT, 0, false, false, false});
        halves_of_atlas(&found, weights);
        assert_true(weights[0] > 0.9999 && weights[1] > 0.9999);
        free(found.texels);
        lobe_scene_destroy(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_sizes_are_clustered_exactly),
        cmocka_unit_test(a_large_odd_map_is_clustered_exactly),
        cmocka_unit_test(what_is_asked_for_is_stored),
        cmocka_unit_test(widths_are_convolved_and_mapped),
        cmocka_unit_test(directions_are_divided_as_in_the_paper),
        cmocka_unit_test(eight_bit_normals_are_decoded),
        cmocka_unit_test(every_level_integrates_to_one),
        cmocka_unit_test(object_space_is_tangent_space_turned),
        cmocka_unit_test(camera_space_is_tangent_space_turned),
        cmocka_unit_test(an_uncovered_atlas_has_no_weight),
        cmocka_unit_test(back_faces_are_left_out_in_camera_space),
    };
    return cmocka_run_group_tests(tests, fixture_create, fixture_destroy);
}
