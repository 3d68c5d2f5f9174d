#ifndef SCENES_BUILTIN_HALL_H
#define SCENES_BUILTIN_HALL_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// The parts of the built-in scene `hall`. All errors: LOBE_ERROR_OUT_OF_MEMORY.

/// The hall's materials, in this order. Each is one file, scenes/hall_<name>.c.
typedef enum hall_material {
    HALL_FLOOR,   ///< polished slabs, wet in places, with brass inlays; 4 m a tile
    HALL_MASONRY, ///< ashlar; 2.4 m a tile
    HALL_MARBLE,  ///< veined, polished; 1.1 m a tile
    HALL_BRONZE,  ///< hammered, with patina; 0.4 m a tile
    HALL_CLOTH,   ///< cloth of half-vector lobes, embroidered with gold; 1.2 m a tile
} hall_material;

#define HALL_FLOOR_TILE   4.0f
#define HALL_MASONRY_TILE 2.4f
#define HALL_MARBLE_TILE  1.1f
#define HALL_BRONZE_TILE  0.4f
#define HALL_CLOTH_TILE   1.2f

lobe_result scenes_hall_add_floor(lobe_scene *scene, const lobe_host *host);
lobe_result scenes_hall_add_masonry(lobe_scene *scene, const lobe_host *host);
lobe_result scenes_hall_add_marble(lobe_scene *scene, const lobe_host *host);
lobe_result scenes_hall_add_bronze(lobe_scene *scene, const lobe_host *host);
lobe_result scenes_hall_add_cloth(lobe_scene *scene, const lobe_host *host);

/// Metres. Columns stand on the floor, y = 0, around their axes; arches spring from them.
#define HALL_BAY           3.6  ///< from axis to axis
#define HALL_COLUMN_HEIGHT 4.4f ///< with plinth and abacus
#define HALL_WALL_HEIGHT   3.2  ///< above the columns
#define HALL_WALL_DEPTH    0.6

/// A column's meshes, each around the axis: the turned marble, the bronze capital and the ring
/// about its foot.
lobe_result scenes_hall_make_column(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_capital(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_ring(const lobe_host *host, lobe_mesh *mesh);

/// Between two columns, x along the wall, 0 in the middle; y = 0 where the arch springs; the
/// middle of the wall at z = 0. The arch has both of its faces, the spandrels above it the one at
/// z > 0.
lobe_result scenes_hall_make_arch(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_spandrels(const lobe_host *host, lobe_mesh *mesh);

/// A banner that hangs from the origin downwards, 1.2 m wide along x, its front towards +z.
lobe_result scenes_hall_make_banner(const lobe_host *host, lobe_mesh *mesh);

#endif
