#ifndef SCENES_BUILTIN_HALL_H
#define SCENES_BUILTIN_HALL_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// The parts of the built-in scene `hall`. All errors: LOBE_ERROR_OUT_OF_MEMORY.

/// The hall's materials, in this order. Each is one file, scenes/builtin/hall/<name>.c.
typedef enum hall_material {
    HALL_FLOOR,   ///< polished slabs, wet in places, with brass inlays; 4 m per tile
    HALL_MASONRY, ///< ashlar; 2.4 m per tile
    HALL_MARBLE,  ///< veined, polished; 1.1 m per tile
    HALL_BRONZE,  ///< hammered, with patina; 0.4 m per tile
    HALL_CLOTH,   ///< cloth of half-vector lobes, embroidered with gold; 1.2 m per tile
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

/// Metres. Columns stand around their axes on the floor, y = 0; arches spring from them.
#define HALL_BAY           3.6  ///< from axis to axis
#define HALL_COLUMN_HEIGHT 4.4f ///< with plinth and abacus
#define HALL_WALL_HEIGHT   3.2  ///< above the columns
#define HALL_WALL_DEPTH    0.6

/// The meshes of a column, each around its axis: the turned marble, the bronze capital, and the
/// bronze ring around its foot.
lobe_result scenes_hall_make_column(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_capital(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_ring(const lobe_host *host, lobe_mesh *mesh);

/// The wall between two columns: x along the wall, 0 in the middle; y = 0 where the arch springs; z
/// = 0 in the middle of the wall. The arch has both faces, the spandrels above it only the one at z
/// > 0.
lobe_result scenes_hall_make_arch(const lobe_host *host, lobe_mesh *mesh);
lobe_result scenes_hall_make_spandrels(const lobe_host *host, lobe_mesh *mesh);

/// A banner that hangs down from the origin, 1.2 m wide along x, its front towards +z.
lobe_result scenes_hall_make_banner(const lobe_host *host, lobe_mesh *mesh);

#endif
