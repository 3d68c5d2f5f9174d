#ifndef SCENES_MESH_TARGET_PARTS_H
#define SCENES_MESH_TARGET_PARTS_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/deformation.h>
#include <lobe/host.h>
#include <lobe/scene.h>

#define NO_DELTA UINT32_MAX

/// What of a mesh its morph targets change, so that work on one takes no longer than that. Marks
/// are the number of the target that set them last, plus one.
typedef struct target_parts {
    lobe_mesh *mesh;
    const lobe_host *host;
    uint32_t *first_deltas;            ///< of each target: the beginning of its numbers in the next
    uint32_t *deltas;                  ///< numbers of deltas, by targets
    uint32_t *vertices;                ///< of each delta
    uint32_t *welded;                  ///< of each vertex
    uint32_t *groups;                  ///< of each vertex, the first welded one of the same tangent
    uint32_t *first_corners, *corners; ///< of each welded vertex, as for deltas
    uint32_t *moved, *changed;         ///< marks of welded vertices: by the target, or turned by it
    uint32_t *shared;                  ///< marks of triangles that have such a vertex
    uint32_t *places;  ///< of each vertex, its vertex in the open part, plus one; 0: none
    uint32_t *scratch; ///< a number for each delta and each corner
} target_parts;

/// The triangles that a target changes and those beside them, at rest. One is open at a time.
typedef struct target_part {
    lobe_mesh mesh;
    uint32_t target;
    uint32_t *triangles; ///< of the whole mesh; owned by the parts
    size_t triangle_count;
    uint32_t *whole;  ///< of each vertex, that of the whole mesh
    uint32_t *deltas; ///< of each vertex, or NO_DELTA
} target_part;

/// Of a mesh with deltas. `set`: of the texture coordinates by which vertices are welded. To be
/// closed also if it fails: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_target_parts_open(target_parts *parts, lobe_mesh *mesh, uint32_t set,
                                     const lobe_host *host);
void scenes_target_parts_close(target_parts *parts);

/// Without triangles, and without a mesh, if the target moves nothing. To be closed also if it
/// fails: LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_target_part_open(target_parts *parts, uint32_t target, target_part *part);
void scenes_target_part_close(target_parts *parts, target_part *part);

/// Whether the target turns vertex `i` of the part; it leaves alone those at the part's border.
bool scenes_target_part_turns(const target_parts *parts, const target_part *part, size_t i);

/// Logs it, and returns LOBE_ERROR_OUT_OF_MEMORY.
lobe_result scenes_target_parts_fail_memory(const target_parts *parts);

#endif
