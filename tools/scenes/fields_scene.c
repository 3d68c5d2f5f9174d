#include "tools/scenes/fields_scene.h"

#include <math.h>
#include <string.h>

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/random.h"
#include "scenes/mesh/shape.h"
#include "scenes/mesh/vector.h"
#include "scenes/scene/scene.h"

// Tan et al. 2005, "Multiresolution Reflectance Filtering", section 5: from a single bump to fields
// of them, two kinds side by side that look alike up close and differently from afar, because
// domes have all slopes and pyramids four.

enum { TEXELS = 512, ACROSS = 8, CELL = TEXELS / ACROSS };

/// Metres: of a bump's cell, and of either field.
#define PITCH 0.04f
#define DEPTH 24.0f
#define WIDTH 12.0f

typedef struct bump {
    double radius;       ///< in cells
    double cosine, sine; ///< by which it is turned
    double slope;        ///< at its rim, or of its faces
} bump;

/// Each a little different.
static bump bump_of(uint32_t column, uint32_t row, uint64_t seed) {
    random_sequence sequence = scenes_random_start(seed + row * ACROSS + column);
    const double turn = scenes_random_between(&sequence, -0.3, 0.3);
    return (bump){.radius = scenes_random_between(&sequence, 0.36, 0.47),
                  .cosine = cos(turn),
                  .sine = sin(turn),
                  .slope = scenes_random_between(&sequence, 0.7, 0.95)};
}

/// The cap of a sphere. (x, y): from the middle, in cells.
static vector3 normal_of_dome(const bump *b, double x, double y) {
    const double distance = hypot(x, y) / b->radius;
    if (distance >= 1)
        return (vector3){0, 0, 1};
    // The sine of the normal's angle grows in proportion to the distance.
    const double rim = b->slope / sqrt(1 + b->slope * b->slope);
    return (vector3){rim * x / b->radius, rim * y / b->radius,
                     sqrt(1 - rim * rim * distance * distance)};
}

static vector3 normal_of_pyramid(const bump *b, double x, double y) {
    const double u = b->cosine * x + b->sine * y, v = b->cosine * y - b->sine * x;
    if (fmax(fabs(u), fabs(v)) >= 0.8 * b->radius)
        return (vector3){0, 0, 1};
    const double scale = 1 / sqrt(1 + b->slope * b->slope);
    const double along = fabs(u) > fabs(v) ? copysign(b->slope * scale, u) : 0;
    const double across = fabs(u) > fabs(v) ? 0 : copysign(b->slope * scale, v);
    return (vector3){b->cosine * along - b->sine * across, b->sine * along + b->cosine * across,
                     scale};
}

typedef vector3 (*bump_normal)(const bump *b, double x, double y);

static void paint(lobe_image *image, bump_normal normal_of, uint64_t seed) {
    uint8_t *texel = image->texels;
    for (uint32_t y = 0; y < TEXELS; y++)
        for (uint32_t x = 0; x < TEXELS; x++, texel += 4) {
            const bump b = bump_of(x / CELL, y / CELL, seed);
            const vector3 normal =
                normal_of(&b, (x % CELL + 0.5) / CELL - 0.5, (y % CELL + 0.5) / CELL - 0.5);
            const double components[3] = {normal.x, -normal.y, normal.z};
            for (int i = 0; i < 3; i++)
                texel[i] = (uint8_t)lround(127.5 + 127.5 * components[i]);
            texel[3] = 255;
        }
}

static lobe_result add_material(lobe_scene *scene, const char *name, bump_normal normal_of,
                                const float colour[3], const lobe_host *host) {
    lobe_image image;
    lobe_material material;
    uint32_t index;
    lobe_material_default(&material);
    memcpy(material.base_colour, colour, 3 * sizeof *colour);
    material.metallic = 0.6f; // so that faces that mirror no light can be seen
    material.roughness = 0.45f;
    material.distribution = LOBE_DISTRIBUTION_BECKMANN;
    lobe_result result = lobe_image_allocate(&image, LOBE_FORMAT_RGBA8_UNORM, TEXELS, TEXELS, host);
    if (result != LOBE_OK)
        return result;
    paint(&image, normal_of, 2005);
    result = scenes_add_image(scene, name, &image, host, &index);
    material.normal_map.image = (int32_t)index;
    return result ? result : scenes_add_material(scene, name, &material, host, NULL);
}

static lobe_result add_materials(lobe_scene *scene, const lobe_host *host) {
    static const float copper[3] = {0.95f, 0.64f, 0.54f}, steel[3] = {0.6f, 0.64f, 0.7f};
    const lobe_result result = add_material(scene, "domes", normal_of_dome, copper, host);
    return result ? result : add_material(scene, "pyramids", normal_of_pyramid, steel, host);
}

/// Beside each other, from the eye into the distance.
static lobe_result add_field(lobe_scene *scene, uint32_t material, float x, const lobe_host *host) {
    lobe_mesh mesh;
    lobe_result result = scenes_shape_plane(WIDTH, DEPTH, PITCH * ACROSS, host, &mesh);
    if (result != LOBE_OK)
        return result;
    for (size_t i = 0; i < mesh.vertex_count; i++)
        mesh.vertices[i].position[0] += x;
    return scenes_place_mesh(scene, &mesh, material, host);
}

static lobe_result add_fields(lobe_scene *scene, const lobe_host *host) {
    const lobe_result result = add_field(scene, 0, -0.5f * WIDTH, host);
    return result ? result : add_field(scene, 1, 0.5f * WIDTH, host);
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {-0.6f, -0.48f, 0.64f},
         .intensity = {2.4f, 2.3f, 2}},
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.64f, -0.6f, -0.48f},
         .intensity = {0.6f, 0.9f, 1.5f}},
    };
    scenes_set_camera(scene, (float[]){0, 0.1f, 0.07f}, (float[]){0, 0, 0}, 40);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.25f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

lobe_result fields_scene(const char *assets, const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {add_materials, add_fields, add_view, NULL};
    (void)assets;
    return scenes_builtin_assemble("fields", steps, host, scene);
}
