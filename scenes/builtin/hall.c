#include "scenes/builtin/builtin.h"

#include "scenes/builtin/assembly.h"
#include "scenes/builtin/hall/hall.h"
#include "scenes/mesh/mesh.h"
#include "scenes/mesh/shape.h"
#include "scenes/scene/scene.h"

// Xu et al. 2017, "Real-Time Linear BRDF MIP-Mapping", Fig. 6 and section 5.2, has Crytek's Sponza
// with floor and fabric of maps up to 2048 x 2048 texels. It is replaced here by our own hall: a
// nave between two arcades, closed by a third, open to the sky, and hung with banners.

enum { BAYS = 10, END_BAYS = 3, BANNERS = 6 };

static const double nave_half_width = 3; // metres, to the columns' axes
static const double first_axis = 1.8;    // z of the nearest columns, metres
static const double end_axis = first_axis - (BAYS + 1) * HALL_BAY;
static const double hall_half_width = END_BAYS * HALL_BAY / 2;

// Adds an instance, turned by quarter turns, counter-clockwise as seen from above.
static lobe_result place(lobe_scene *scene, uint32_t mesh, hall_material material, int quarters,
                         double x, double y, double z, const lobe_host *host) {
    static const float cosines[4] = {1, 0, -1, 0}, sines[4] = {0, 1, 0, -1};
    float transform[16] = {[5] = 1, [15] = 1};
    transform[0] = transform[10] = cosines[quarters];
    transform[8] = sines[quarters];
    transform[2] = -sines[quarters];
    transform[12] = (float)x, transform[13] = (float)y, transform[14] = (float)z;
    return scenes_add_instance(scene, mesh, material, transform, host);
}

// Adds the mesh that `make` makes.
static lobe_result add_mesh(lobe_scene *scene,
                            lobe_result (*make)(const lobe_host *host, lobe_mesh *mesh),
                            const lobe_host *host, uint32_t *index) {
    lobe_mesh mesh;
    lobe_result status = make(host, &mesh);
    return status ? status : scenes_add_mesh(scene, &mesh, host, index);
}

static lobe_result add_box(lobe_scene *scene, double width, double height, double depth, float tile,
                           const lobe_host *host, uint32_t *index) {
    lobe_mesh mesh;
    const float size[3] = {(float)width, (float)height, (float)depth};
    lobe_result status = scenes_shape_box(size, tile, host, &mesh);
    return status ? status : scenes_add_mesh(scene, &mesh, host, index);
}

// The axis of one of the hall's columns: first those of both arcades, then those of the end wall.
static void find_axis(int index, double *x, double *z) {
    int of_nave = 2 * (BAYS + 1);
    *x = index % 2 ? nave_half_width : -nave_half_width;
    *z = first_axis - index / 2 * HALL_BAY;
    if (index >= of_nave) {
        *x = (index - of_nave) * HALL_BAY - hall_half_width;
        *z = end_axis;
    }
}

static lobe_result add_columns(lobe_scene *scene, const lobe_host *host) {
    enum { COLUMNS = 2 * (BAYS + 1) + END_BAYS + 1 };
    uint32_t column, capital, ring, block;
    lobe_result status = add_mesh(scene, scenes_hall_make_column, host, &column);
    if (!status)
        status = add_mesh(scene, scenes_hall_make_capital, host, &capital);
    if (!status)
        status = add_mesh(scene, scenes_hall_make_ring, host, &ring);
    if (!status)
        status = add_box(scene, 1, 0.2, 1, HALL_MARBLE_TILE, host, &block);
    for (int i = 0; !status && i < COLUMNS; i++) {
        double x, z;
        find_axis(i, &x, &z);
        const struct {
            uint32_t mesh;
            hall_material material;
            double y;
        } parts[] = {{column, HALL_MARBLE, 0},
                     {capital, HALL_BRONZE, 0},
                     {ring, HALL_BRONZE, 0},
                     {block, HALL_MARBLE, 0.1},
                     {block, HALL_MARBLE, HALL_COLUMN_HEIGHT - 0.1}};
        for (size_t k = 0; !status && k < sizeof parts / sizeof *parts; k++)
            status = place(scene, parts[k].mesh, parts[k].material, 0, x, parts[k].y, z, host);
    }
    return status;
}

// The wall of one bay around (x, z), turned by `quarters` quarter turns.
static lobe_result add_bay(lobe_scene *scene, uint32_t arch, uint32_t spandrels, int quarters,
                           double x, double z, const lobe_host *host) {
    const double y = HALL_COLUMN_HEIGHT;
    lobe_result status = place(scene, arch, HALL_MARBLE, quarters, x, y, z, host);
    if (!status)
        status = place(scene, spandrels, HALL_MASONRY, quarters, x, y, z, host);
    if (!status)
        status = place(scene, spandrels, HALL_MASONRY, (quarters + 2) % 4, x, y, z, host);
    return status;
}

static lobe_result add_arcades(lobe_scene *scene, const lobe_host *host) {
    uint32_t arch, spandrels, cornice;
    const double length = BAYS * HALL_BAY, middle = first_axis - length / 2;
    const double top = HALL_COLUMN_HEIGHT + HALL_WALL_HEIGHT + 0.15;
    lobe_result status = add_mesh(scene, scenes_hall_make_arch, host, &arch);
    if (!status)
        status = add_mesh(scene, scenes_hall_make_spandrels, host, &spandrels);
    if (!status)
        status = add_box(scene, 1, 0.3, length + 0.4, HALL_MARBLE_TILE, host, &cornice);
    for (int side = -1; !status && side <= 1; side += 2) {
        double x = side * nave_half_width;
        for (int i = 0; !status && i < BAYS; i++)
            status = add_bay(scene, arch, spandrels, side < 0 ? 1 : 3, x,
                             first_axis - (i + 0.5) * HALL_BAY, host);
        if (!status)
            status = place(scene, cornice, HALL_MARBLE, 0, x, top, middle, host);
    }
    for (int i = 0; !status && i < END_BAYS; i++)
        status = add_bay(scene, arch, spandrels, 0, (i + 0.5) * HALL_BAY - hall_half_width,
                         end_axis, host);
    return status;
}

static lobe_result add_floor_and_walls(lobe_scene *scene, const lobe_host *host) {
    static const double length = 56, middle = -20; // metres, along z
    const double height = HALL_COLUMN_HEIGHT + HALL_WALL_HEIGHT;
    uint32_t floor, wall;
    lobe_mesh mesh;
    lobe_result status = scenes_shape_plane((float)(2 * hall_half_width + 1), (float)length,
                                            HALL_FLOOR_TILE, host, &mesh);
    if (!status)
        status = scenes_add_mesh(scene, &mesh, host, &floor);
    if (!status)
        status = place(scene, floor, HALL_FLOOR, 0, 0, 0, middle, host);
    if (!status)
        status = add_box(scene, 0.5, height, length, HALL_MASONRY_TILE, host, &wall);
    for (int side = -1; !status && side <= 1; side += 2)
        status = place(scene, wall, HALL_MASONRY, 0, side * (hall_half_width + 0.25), height / 2,
                       middle, host);
    return status;
}

// They hang from rods at every other column, into the nave.
static lobe_result add_banners(lobe_scene *scene, const lobe_host *host) {
    uint32_t banner, rod;
    lobe_result status = add_mesh(scene, scenes_hall_make_banner, host, &banner);
    if (!status)
        status = add_box(scene, 1.6, 0.05, 0.05, HALL_BRONZE_TILE, host, &rod);
    for (int i = 0; !status && i < BANNERS; i++) {
        double x = (i % 2 ? 1 : -1) * (nave_half_width - 1.1), y = HALL_COLUMN_HEIGHT + 0.9;
        double z = first_axis - (i / 2 * 2 + 2) * HALL_BAY;
        status = place(scene, banner, HALL_CLOTH, 0, x, y, z, host);
        if (!status)
            status = place(scene, rod, HALL_BRONZE, 0, x + (i % 2 ? 0.1 : -0.1), y, z, host);
    }
    return status;
}

static lobe_result add_view(lobe_scene *scene, const lobe_host *host) {
    static const lobe_light lights[] = {
        {.type = LOBE_LIGHT_DIRECTIONAL,
         .direction = {0.28f, -0.48f, 0.8313844f},
         .intensity = {3.2f, 2.9f, 2.4f}},
        {.type = LOBE_LIGHT_POINT, .position = {0.4f, 4.6f, 2}, .intensity = {34, 28, 21}},
        {.type = LOBE_LIGHT_POINT, .position = {0, 3.8f, -9}, .intensity = {40, 31, 21}},
        {.type = LOBE_LIGHT_POINT, .position = {0, 4.4f, -24}, .intensity = {60, 50, 38}},
    };
    scenes_set_camera(scene, (float[]){0.7f, 1.7f, 3.4f}, (float[]){-0.2f, 2.3f, -10}, 50);
    scene->background[0] = 0.42f, scene->background[1] = 0.55f, scene->background[2] = 0.75f;
    return scenes_add_lights(scene, lights, sizeof lights / sizeof *lights, host);
}

// Materials in the order of hall_material.
lobe_result scenes_builtin_hall(const lobe_host *host, lobe_scene **scene) {
    static const builtin_step steps[] = {scenes_hall_add_floor,
                                         scenes_hall_add_masonry,
                                         scenes_hall_add_marble,
                                         scenes_hall_add_bronze,
                                         scenes_hall_add_cloth,
                                         add_columns,
                                         add_arcades,
                                         add_banners,
                                         add_floor_and_walls,
                                         add_view,
                                         NULL};
    return scenes_builtin_assemble("hall", steps, host, scene);
}
