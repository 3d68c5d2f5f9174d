#ifndef PASSES_UPLOAD_DEVICE_SCENE_H
#define PASSES_UPLOAD_DEVICE_SCENE_H

#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/renderer.h>
#include <lobe/scene.h>

#include "passes/filters/moments/partition.h"
#include "passes/upload/mesh_density.h"
#include "shaders/interface/material.h"

/// A map of a material, ready to be bound.
typedef struct device_map {
    const lobe_texture_use *use; ///< NULL: the material has no such map
    uint32_t width, height;      ///< texels
} device_map;

typedef struct device_material {
    const lobe_material *material;
    lobe_buffer *constants;
    /// The same without colours and metal, on which maps of directions and widths do not depend: a
    /// change of those alone leaves them be.
    lobe_buffer *map_constants;
    struct material_constants map_values; ///< what `map_constants` holds
    device_map maps[MAP_COUNT];
    uint32_t map_bits;           ///< bit MAP_...: there is one
    uint32_t second_coordinates; ///< bit MAP_...: it uses the second set
    bool metallic_varies;        ///< the width map says where the material is metal
    float metallic;              ///< its metallic factor, times the map's where that is constant
    uint32_t subdivision;        ///< [0, 2]: what its mixtures of lobes need in tangent space
    bool widths_differ;          ///< base lobes of one texel differ in width
    moment_partition_cache partition; ///< of lobes into bins, where a filter asked for one
} device_material;

typedef struct device_instance {
    uint32_t mesh, material;
    bool mirrored; ///< the transform turns left into right
    /// The transform does not bend angles: directions of the mesh can be turned into the world's.
    bool keeps_angles;
    /// The lobes' texture coordinates stay within [0, 1] and do not overlap: each texel belongs
    /// to one place of the mesh.
    bool is_atlas;
} device_instance;

/// The device's copy of a scene: only what instances use.
typedef struct device_scene {
    const lobe_scene *scene;
    const lobe_allocator *allocator; ///< the device's
    lobe_texture *white;             ///< one white texel, where a map is missing
    lobe_texture **images;           ///< one an image of the scene; NULL: not used
    lobe_texture *environment;       ///< its image; NULL: none
    device_material *materials;
    lobe_buffer **vertices; ///< one a mesh; NULL: not used
    lobe_buffer **indices;
    mesh_density *densities; ///< one a mesh
    device_instance *instances;
} device_scene;

/// Uploads. `scene` must live as long as the copy. Errors: as lobe_renderer_set_scene.
lobe_result passes_device_scene_create(lobe_device *device, const lobe_scene *scene,
                                       const lobe_host *host, device_scene **result);
/// Takes over what changed of the scene. Errors: as lobe_renderer_update_scene;
/// LOBE_ERROR_MALFORMED and _INVALID_ARGUMENT are found before anything is changed, after others
/// the copy is no more than good for being destroyed.
lobe_result passes_device_scene_update(lobe_device *device, device_scene *scene,
                                       const lobe_scene_changes *changes, const lobe_host *host);
/// Clears the pointer; NULL is fine.
void passes_device_scene_destroy(device_scene **scene);

/// What part of a half-vector material's reflectance is one lobe's, by luminance [0, 1].
float passes_material_lobe_share(const lobe_material *material, uint32_t lobe);

/// The texture of a material's map, or the white one.
lobe_resource passes_device_map_import(lobe_graph *graph, const device_scene *scene,
                                       const device_material *material, uint32_t map);
/// How a map's texels are read, levels apart.
lobe_sampler passes_device_map_sampler(const device_material *material, uint32_t map);

#endif
