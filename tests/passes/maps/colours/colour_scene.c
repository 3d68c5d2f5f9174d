#include "tests/passes/maps/colours/colour_scene.h"

#include <math.h>
#include <string.h>

#include "tests/passes/support/scene_builder.h"

const colour_way colours_of_no_normals = {"random", 128, 128, 0, 1, -1, 0, 0},
                 colours_of_normals = {"clear", 128, 128, 0.7, 1, -1, 0, 0};

static const float cutoff = 0.5f;

void colour_scene_normal(const lobe_image *normals, size_t texel, double normal[2]) {
    double square = 0, n[3];
    for (size_t j = 0; j < 3; j++) {
        n[j] = 2 * (double)((const float *)normals->texels)[4 * texel + j] - 1;
        square += n[j] * n[j];
    }
    for (int j = 0; j < 2; j++)
        normal[j] = n[j] / sqrt(square);
}

static bool is_masked(const colour_way *way) {
    return way->least_x > -1;
}

static double alpha_of(const colour_way *way) {
    return way->alpha > 0 ? way->alpha : 1;
}

bool colour_scene_keeps(const colour_way *way, const lobe_image *colours, size_t texel) {
    const float alpha = ((const float *)colours->texels)[4 * texel + 3];
    return !is_masked(way) || alpha_of(way) * (double)alpha >= (double)cutoff;
}

/// What is cut away would be kept without the factor of alpha, if there is one.
static void fill_colours(const colour_way *way, const lobe_image *normals, lobe_image *colours) {
    lobe_image noise = random_map(way->width, way->height, 0.3, 0.7, 55);
    memcpy(colours->texels, noise.texels, (size_t)16 * way->width * way->height);
    lobe_image_free(&noise);
    for (uint32_t i = 0; i < way->width * way->height; i++) {
        float *texel = (float *)colours->texels + (size_t)4 * i;
        double normal[2];
        colour_scene_normal(normals, i, normal);
        if (i % way->width < way->part * way->width)
            for (int k = 0; k < 3; k += 2)
                texel[k] += (float)(way->follow * (1 - k) * normal[0]);
        texel[3] = normal[0] > way->least_x ? 1 : way->alpha > 0 ? 0.55f : 0;
    }
}

lobe_scene *colour_scene(const colour_way *way) {
    lobe_scene *scene = scene_begin();
    lobe_material material = microfacet_material(LOBE_DISTRIBUTION_GGX, 0.6, (float)way->metallic);
    lobe_image normals = random_normal_map(way->width, way->height, 0.6, 141),
               colours = map_image(LOBE_FORMAT_RGBA32_FLOAT, way->width, way->height);
    fill_colours(way, &normals, &colours);
    for (int j = 0; j < 3; j++)
        material.base_colour[j] = 1;
    material.base_colour[3] = (float)alpha_of(way);
    material.alpha_mask = is_masked(way);
    material.alpha_cutoff = cutoff;
    material.normal_map = scene_add_map(scene, normals);
    material.base_colour_map = scene_add_map(scene, colours);
    scene_add_square(scene, &material, 20, NULL);
    scene_add_sun(scene, (double[]){0.8, 0.6, 0}, 1);
    scene_look_from(scene, (double[]){0, 1, 0.01}, 0.4);
    scene_end(scene);
    return scene;
}

void colour_scene_recolour(lobe_scene *scene, const colour_way *way) {
    fill_colours(way, &scene->images[COLOUR_SCENE_NORMALS].image,
                 &scene->images[COLOUR_SCENE_COLOURS].image);
}
