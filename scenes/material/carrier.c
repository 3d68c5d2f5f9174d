#include "scenes/material/carrier.h"

#include <math.h>

#include "scenes/builtin/noise.h"
#include "scenes/mesh/circle.h"
#include "scenes/mesh/grid_mesh.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// ---------------------------------------------------------------------------------------------
// Cloth

// Metres.
static const double cloth_width = 2.2, cloth_height = 1.5, texel_size = 0.0005;
// For maps with few texels, which would otherwise repeat too often to be recognisable.
static const double smallest_tile = 0.05;

// Waves run across the cloth and swing slightly on the way down; the lower edge hangs free.
static void place_on_cloth(const void *shape, double u, double v, lobe_scene_vertex *vertex) {
    const double *tile = shape;
    double wave[2];
    scenes_circle_point(4 * u + 0.35 * scenes_noise_gradient(1.5 * u, 1.5 * v, 16, 61, NULL), wave);
    vertex->position[0] = (float)((u - 0.5) * cloth_width);
    vertex->position[1] = (float)((0.5 - v) * cloth_height);
    vertex->position[2] = (float)((0.02 + 0.02 * v) * wave[1]);
    vertex->texture_coordinates[0][0] = (float)(u * cloth_width / *tile);
    vertex->texture_coordinates[0][1] = (float)(v * cloth_height / *tile);
}

static lobe_result make_cloth(const lobe_scene *scene, const lobe_host *host, lobe_mesh *mesh) {
    uint32_t texels = 0;
    for (size_t i = 0; i < scene->image_count; i++) {
        const lobe_image *image = &scene->images[i].image;
        uint32_t extent = image->width > image->height ? image->width : image->height;
        texels = extent > texels ? extent : texels;
    }
    double tile = fmax(texels * texel_size, smallest_tile);
    const grid_mesh grid = {
        .name = "cloth", .rows = 60, .columns = 120, .place = place_on_cloth, .shape = &tile};
    return scenes_grid_mesh_make(&grid, host, mesh);
}

// ---------------------------------------------------------------------------------------------

static lobe_result make_mesh(const lobe_scene *scene, lobe_carrier carrier, const lobe_host *host,
                             lobe_mesh *mesh) {
    switch (carrier) {
    case LOBE_CARRIER_SPHERE:
        return scenes_shape_sphere(64, 128, 4, 2, host, mesh);
    case LOBE_CARRIER_CLOTH:
        return make_cloth(scene, host, mesh);
    default:
        return scenes_shape_plane(4, 4, 1, host, mesh);
    }
}

static void look(lobe_scene *scene, lobe_carrier carrier) {
    switch (carrier) {
    case LOBE_CARRIER_SPHERE:
        scenes_set_camera(scene, (float[]){0, 0.6f, 3}, (float[]){0, 0, 0}, 42);
        break;
    case LOBE_CARRIER_CLOTH:
        scenes_set_camera(scene, (float[]){1.15f, 0.2f, 1.3f}, (float[]){0.19f, 0.02f, 0}, 40);
        break;
    default:
        scenes_set_camera(scene, (float[]){0, 1.3f, 2.2f}, (float[]){0, -0.1f, 0.1f}, 42);
    }
}

lobe_result scenes_carrier_add(lobe_scene *scene, lobe_carrier carrier, const lobe_host *host) {
    lobe_mesh mesh;
    // A camera may move around the cloth and see its back.
    scene->materials[0].double_sided |= carrier == LOBE_CARRIER_CLOTH;
    lobe_result status = make_mesh(scene, carrier, host, &mesh);
    if (!status)
        status = scenes_place_mesh(scene, &mesh, 0, host);
    look(scene, carrier);
    scene->background[0] = scene->background[1] = scene->background[2] = 0.2f;
    return status;
}

void scenes_carrier_turn_light(lobe_scene *scene, lobe_carrier carrier) {
    static const double degrees[] = {
        [LOBE_CARRIER_PLANE] = 186, [LOBE_CARRIER_SPHERE] = 54, [LOBE_CARRIER_CLOTH] = -17};
    if (scene->has_added_light)
        lobe_environment_turn(scene->environment, degrees[carrier]);
}
