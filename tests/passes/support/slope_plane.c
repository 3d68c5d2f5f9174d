#include "tests/passes/support/slope_plane.h"

#include <math.h>
#include <string.h>

#include "passes/context/sample_pattern.h"
#include "tests/passes/support/shading_reference.h"
#include "tests/reference/vector.h"

lobe_image slope_plane_leaning_map(uint64_t seed) {
    lobe_image image = random_normal_map(8, 8, 0.4, seed);
    float *texel = image.texels;
    for (int i = 0; i < 8 * 8; i++, texel += 4) {
        float x = 2 * texel[0] - 1, z = 2 * texel[2] - 1;
        texel[0] = 0.5f + 0.5f * (0.8f * x + 0.6f * z);
        texel[2] = 0.5f + 0.5f * (0.8f * z - 0.6f * x);
    }
    return image;
}

/// By Box and Muller.
void slope_plane_bumpy_normal(uint32_t texel, double slope, double normal[3]) {
    double u = passes_hashed_number(2 * texel + 1), v = passes_hashed_number(2 * texel + 2);
    double radius = slope * sqrt(-2 * log(1 - u));
    normal[0] = radius * cos(2 * M_PI * v);
    normal[1] = radius * sin(2 * M_PI * v);
    normal[2] = 1;
    reference_normalise(normal);
}

lobe_image slope_plane_bumpy_map(uint32_t extent, double slope) {
    lobe_image image = map_image(LOBE_FORMAT_RGBA32_FLOAT, extent, extent);
    for (uint32_t i = 0; i < extent * extent; i++) {
        float *texel = (float *)image.texels + (size_t)4 * i;
        double normal[3];
        slope_plane_bumpy_normal(i, slope, normal);
        for (int j = 0; j < 3; j++)
            texel[j] = (float)(0.5 + 0.5 * normal[j]);
        texel[3] = 1;
    }
    return image;
}

double slope_plane_bumpy_radiance(const lobe_material *material, uint32_t extent, double slope,
                                  const double outgoing[3], const double incoming[3]) {
    const uint32_t texels = extent * extent;
    double sum = 0;
    for (uint32_t i = 0; i < texels; i++) {
        double normal[3], radiance[3];
        slope_plane_bumpy_normal(i, slope, normal);
        shade_base_material(material, normal, outgoing, incoming, radiance);
        sum += radiance[1] / texels;
    }
    return sum;
}

void slope_plane_direction(double degrees, double azimuth, double direction[3]) {
    double angle = degrees * M_PI / 180;
    direction[0] = sin(angle) * cos(azimuth);
    direction[1] = sin(angle) * sin(azimuth);
    direction[2] = cos(angle);
}

/// From the tangent frame of scene_add_square to the world.
static void to_world(const double tangent[3], double world[3]) {
    world[0] = tangent[0];
    world[1] = tangent[2];
    world[2] = -tangent[1];
}

lobe_scene *slope_plane(const lobe_material *material, const lobe_image *normals,
                        const double outgoing[3], lobe_material *mapped) {
    lobe_scene *scene = scene_begin();
    lobe_image image = map_image(normals->format, normals->width, normals->height);
    memcpy(image.texels, normals->texels,
           (size_t)image.width * image.height * lobe_format_size(image.format));
    *mapped = *material;
    mapped->normal_map = scene_add_map(scene, image);
    mapped->normal_map.nearest = true;
    scene_add_square(scene, mapped, 40, NULL);
    double world[3];
    to_world(outgoing, world);
    scene_look_from(scene, world, 0.2);
    return scene;
}

void slope_plane_add_sun(lobe_scene *scene, const double incoming[3], double intensity) {
    double world[3];
    to_world(incoming, world);
    scene_add_sun(scene, world, intensity);
}

void slope_plane_draw(fixture *f, lobe_scene *scene, const char *filter, const char *setting,
                      float colour[3]) {
    scene_end(scene);
    picture_request request = {
        .filter = filter, .settings = {setting}, .width = 1, .height = 1, .samples = 256};
    lobe_frame frame = draw_scene(f, scene, &request);
    memcpy(colour, pixel_at(&frame.radiance, 0, 0), 3 * sizeof *colour);
    lobe_frame_free(&frame);
}

void slope_plane_draw_lit(fixture *f, const lobe_material *material, const lobe_image *normals,
                          const char *filter, const char *setting, const double outgoing[3],
                          const double incoming[3], float colour[3]) {
    lobe_material mapped;
    lobe_scene *scene = slope_plane(material, normals, outgoing, &mapped);
    slope_plane_add_sun(scene, incoming, 1);
    slope_plane_draw(f, scene, filter, setting, colour);
    lobe_scene_destroy(&scene);
}

const double slope_plane_angles[4] = {0, 35, 65, 80};

void slope_plane_pair(int pair, double outgoing[3], double incoming[3]) {
    slope_plane_direction(slope_plane_angles[pair / 4], 0.4, outgoing);
    slope_plane_direction(slope_plane_angles[pair % 4], 0.4 + 0.7 * pair, incoming);
}

enum { FURNACE_SUNS = 1024 };

/// Suns of equal solid angles.
double slope_plane_furnace(fixture *f, const lobe_material *material, const lobe_image *normals,
                           const char *filter, const char *setting, double degrees) {
    double outgoing[3];
    slope_plane_direction(degrees, 0.3, outgoing);
    lobe_material mapped;
    lobe_scene *scene = slope_plane(material, normals, outgoing, &mapped);
    // A spiral of the golden angle: no ring of suns misses or meets a narrow lobe as a whole.
    for (int i = 0; i < FURNACE_SUNS; i++) {
        const double height = (i + 0.5) / FURNACE_SUNS, azimuth = M_PI * (3 - sqrt(5)) * i;
        const double radius = sqrt(1 - height * height);
        slope_plane_add_sun(scene, (double[]){radius * cos(azimuth), radius * sin(azimuth), height},
                            2 * M_PI / FURNACE_SUNS);
    }
    float colour[3];
    slope_plane_draw(f, scene, filter, setting, colour);
    lobe_scene_destroy(&scene);
    return (double)colour[1];
}
