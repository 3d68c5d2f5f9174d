#include "tests/passes/support/scene_builder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenes/builtin/random.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

static void require(lobe_result result) {
    if (result != LOBE_OK)
        abort();
}

lobe_scene *scene_begin(void) {
    lobe_scene *scene;
    require(scenes_allocate("test", NULL, &scene));
    return scene;
}

lobe_image map_image(lobe_format format, uint32_t width, uint32_t height) {
    lobe_image image;
    require(lobe_image_allocate(&image, format, width, height, NULL));
    return image;
}

lobe_image constant_map(uint32_t width, uint32_t height, float r, float g, float b) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    float *texel = image.texels;
    for (uint32_t i = 0; i < width * height; i++, texel += 4) {
        texel[0] = r;
        texel[1] = g;
        texel[2] = b;
        texel[3] = 1;
    }
    return image;
}

lobe_image random_normal_map(uint32_t width, uint32_t height, double tilt, uint64_t seed) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    random_sequence sequence = scenes_random_start(seed);
    float *texel = image.texels;
    for (uint32_t i = 0; i < width * height; i++, texel += 4) {
        double polar = scenes_random_between(&sequence, 0.02 * tilt, tilt);
        double azimuth = scenes_random_between(&sequence, 0, 2 * M_PI);
        texel[0] = (float)(0.5 + 0.5 * sin(polar) * cos(azimuth));
        texel[1] = (float)(0.5 + 0.5 * sin(polar) * sin(azimuth));
        texel[2] = (float)(0.5 + 0.5 * cos(polar));
        texel[3] = 1;
    }
    return image;
}

lobe_image random_map(uint32_t width, uint32_t height, double low, double high, uint64_t seed) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, width, height);
    random_sequence sequence = scenes_random_start(seed);
    float *value = image.texels;
    for (uint32_t i = 0; i < 4 * width * height; i++)
        *value++ = (float)scenes_random_between(&sequence, low, high);
    return image;
}

lobe_texture_use scene_add_map(lobe_scene *scene, lobe_image image) {
    lobe_texture_use use = LOBE_TEXTURE_NONE;
    uint32_t index;
    require(scenes_add_image(scene, "map", &image, NULL, &index));
    use.image = (int32_t)index;
    return use;
}

void scene_add_square(lobe_scene *scene, const lobe_material *material, double tiles,
                      const float transform[16]) {
    lobe_mesh mesh;
    uint32_t mesh_index, material_index;
    require(scenes_shape_plane(2, 2, (float)(2 / tiles), NULL, &mesh));
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        for (int axis = 0; axis < 2; axis++)
            mesh.vertices[i].texture_coordinates[0][axis] += (float)(0.5 * tiles);
    }
    require(scenes_add_mesh(scene, &mesh, NULL, &mesh_index));
    require(scenes_add_material(scene, "material", material, NULL, &material_index));
    require(scenes_add_instance(scene, mesh_index, material_index, transform, NULL));
}

void scene_add_masked_squares(lobe_scene *scene, double tiles) {
    static const float raised[16] = {
        [0] = 1, [5] = 1, [10] = 1, [12] = 0.5f, [13] = 0.3f, [15] = 1};
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.5, 0);
    material.normal_map = scene_add_map(scene, random_normal_map(32, 32, 0.4, 131));
    scene_add_square(scene, &material, tiles, NULL);
    material.base_colour_map = scene_add_map(scene, random_map(32, 32, 0, 1, 132));
    material.alpha_mask = true;
    material.alpha_cutoff = 0.5f;
    scene_add_square(scene, &material, tiles, raised);
}

void scene_add_sphere(lobe_scene *scene, const lobe_material *material, double tiles) {
    lobe_mesh mesh;
    uint32_t mesh_index, material_index;
    require(scenes_shape_sphere(48, 96, (float)(2 * tiles), (float)tiles, NULL, &mesh));
    require(scenes_add_mesh(scene, &mesh, NULL, &mesh_index));
    require(scenes_add_material(scene, "material", material, NULL, &material_index));
    require(scenes_add_instance(scene, mesh_index, material_index, NULL, NULL));
}

void scene_add_sun(lobe_scene *scene, const double towards[3], double intensity) {
    lobe_light light = {.type = LOBE_LIGHT_DIRECTIONAL};
    double length =
        sqrt(towards[0] * towards[0] + towards[1] * towards[1] + towards[2] * towards[2]);
    for (int i = 0; i < 3; i++) {
        light.direction[i] = (float)(-towards[i] / length);
        light.intensity[i] = (float)intensity;
    }
    require(scenes_add_light(scene, &light, NULL));
}

void scene_set_environment(lobe_scene *scene, lobe_image image) {
    lobe_environment *environment = lobe_allocate(NULL, 1, sizeof *environment);
    char *name = lobe_copy_text(NULL, "environment");
    if (!environment || !name)
        abort();
    *environment = (lobe_environment){.name = name,
                                      .image = image,
                                      .world_from_environment = {{1}, {0, 1}, {0, 0, 1}},
                                      .intensity = 1};
    scene->environment = environment;
}

void scene_surround(lobe_scene *scene, uint32_t height, environment_radiance radiance) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, 2 * height, height);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < 2 * height; x++) {
            // The centre looks to +Z, longitude grows to the left.
            double longitude = M_PI * (1 - (x + 0.5) / height);
            double latitude = M_PI * (0.5 - (y + 0.5) / height);
            const double direction[3] = {cos(latitude) * sin(longitude), sin(latitude),
                                         cos(latitude) * cos(longitude)};
            radiance(direction, (float *)image.texels + 4 * ((size_t)y * 2 * height + x));
        }
    }
    scene_set_environment(scene, image);
}

void scene_look_from(lobe_scene *scene, const double towards[3], double height) {
    double length =
        sqrt(towards[0] * towards[0] + towards[1] * towards[1] + towards[2] * towards[2]);
    scene->camera =
        (lobe_camera){.up = {0, 0, -1}, .orthographic_height = (float)height, .near_plane = 0.01f};
    for (int i = 0; i < 3; i++)
        scene->camera.eye[i] = (float)(4 * towards[i] / length);
    scene->has_camera = true;
}

void scene_look_along(lobe_scene *scene) {
    scene_add_sun(scene, (double[]){0.2, 1, 0.3}, 2);
    scene_add_sun(scene, (double[]){0, 1, -3}, 2);
    scene->has_camera = true;
    scene->camera = (lobe_camera){.eye = {0.5f, 0.4f, 1.4f},
                                  .up = {0, 1, 0},
                                  .vertical_field_of_view = 0.9f,
                                  .near_plane = 0.01f};
}

void scene_look_down(lobe_scene *scene, double height) {
    scene_look_from(scene, (double[]){0, 1, 0}, height);
}

void scene_end(lobe_scene *scene) {
    // A scene without a light would be given one, which no test wants.
    if (scene->light_count == 0 && !scene->environment)
        scene_add_sun(scene, (double[]){0, 1, 0}, 1);
    require(scenes_complete(scene, false, NULL));
}

void scene_end_with_square(lobe_scene *scene, const lobe_material *material) {
    scene_add_square(scene, material, 1, NULL);
    scene_look_down(scene, 2);
    scene_end(scene);
}

lobe_material half_vector_material(lobe_distribution distribution, float width) {
    lobe_material material;
    lobe_material_default(&material);
    material.model = LOBE_MATERIAL_HALF_VECTOR_LOBES;
    material.distribution = distribution;
    material.lobe_count = 1;
    material.lobes[0] = (lobe_base_lobe){{0, 0, 1}, width, {1, 1, 1}};
    for (int i = 0; i < 3; i++)
        material.base_colour[i] = 0;
    return material;
}

lobe_material microfacet_material(lobe_distribution distribution, double roughness,
                                  double metallic) {
    lobe_material material;
    lobe_material_default(&material);
    material.distribution = distribution;
    material.roughness = (float)roughness;
    material.metallic = (float)metallic;
    return material;
}
