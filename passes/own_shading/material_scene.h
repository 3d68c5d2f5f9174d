#ifndef PASSES_OWN_SHADING_MATERIAL_SCENE_H
#define PASSES_OWN_SHADING_MATERIAL_SCENE_H

#include <lobe/scene.h>

/// The images, materials and environment of another scene, each material on an instance with the
/// same index. Of the one mesh nothing can be concluded: its texture coordinates are one point, so
/// that any map may be magnified.
typedef struct material_scene {
    lobe_scene scene;
    const lobe_scene *source;
    lobe_mesh mesh;
    lobe_scene_vertex vertices[3];
    uint32_t indices[3];
    lobe_instance instances[];
} material_scene;

/// `vertex_colours`: the mesh has any. NULL: out of memory. Freed with lobe_release.
material_scene *passes_material_scene_create(const lobe_scene *source, bool vertex_colours,
                                             const lobe_allocator *allocator);
/// Takes over the environment that the source has now.
void passes_material_scene_update(material_scene *scene);

#endif
