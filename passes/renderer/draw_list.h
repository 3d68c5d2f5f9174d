#ifndef PASSES_RENDERER_DRAW_LIST_H
#define PASSES_RENDERER_DRAW_LIST_H

#include "passes/context/filter.h"
#include "shaders/interface/instance.h"

/// The draws of a picture: instances of one mesh and one material are drawn together where they
/// share filtered maps, so that the host's work grows with the number of draws.

/// What sees the instances of a list.
typedef enum draw_view {
    DRAW_FOR_PICTURE,
    DRAW_FOR_LIGHT, ///< the shadow map that is being drawn
    DRAW_VIEWS,
} draw_view;

/// Those of a batch that a view may show (passes/renderer/culling/culling.h).
typedef struct seen_instances {
    lobe_resource transforms; ///< as those of the batch, from its first on; all zero: not culled
    lobe_resource previous_transforms; ///< the same of the previous frame; none without motion
    lobe_resource arguments;           ///< lobe_draw_arguments of all batches that are culled
    uint32_t record;                   ///< index into them
} seen_instances;

/// Instances that are drawn together. They have the same mesh and material, and all mirror or none.
typedef struct instance_batch {
    size_t instance; ///< the first of them
    uint32_t count;
    bool mirrored; ///< the transforms mirror
    const filtered_appearance *appearance;
    displaced_geometry displaced;      ///< what is drawn instead of the mesh; all zero: nothing
    lobe_resource transforms;          ///< buffer of struct instance_constants
    lobe_resource previous_transforms; ///< the same of the previous frame; none without motion
    seen_instances seen[DRAW_VIEWS];
    uint32_t first;        ///< index of the first instance's
    uint32_t start;        ///< the same among the transforms of the whole list
    uint32_t next_of_mesh; ///< 1 + index of another batch of the mesh; 0: none
} instance_batch;

/// Material by material, then in the order of their first instances.
typedef struct draw_list {
    instance_batch *batches;
    uint32_t batch_count;
    bool draws_all; ///< nothing is culled: for tests
    // Memory that is kept from frame to frame.
    uint32_t *batch_of;                    ///< of each instance of the scene
    uint32_t *of_mesh;                     ///< as `next_of_mesh`: of each mesh
    struct instance_constants *transforms; ///< of these instances, batch by batch
    size_t room;                           ///< for so many instances
} draw_list;

/// Memory for a number of meshes, without any instances. False if there is not enough; then the
/// list is to be destroyed all the same.
bool passes_draw_list_create(draw_list *list, size_t meshes, const lobe_allocator *allocator);
/// Memory for this number of instances; false if there is not enough: that of before is still
/// there. To be called between frames.
bool passes_draw_list_reserve(draw_list *list, size_t room, const lobe_allocator *allocator);
void passes_draw_list_destroy(draw_list *list);

/// Empties the list.
void passes_draw_list_begin(draw_list *list, const device_scene *scene);
/// Adds an instance that is not hidden. Those of a material follow one another.
/// `shared`: the maps of `appearance` are those of other instances of the material, too.
void passes_draw_list_add(draw_list *list, const device_scene *scene, size_t instance,
                          const filtered_appearance *appearance, bool shared);
/// Uploads the transforms for this frame, after the last instance.
void passes_draw_list_end(draw_list *list, const filter_context *context);
/// Then those of the previous frame: one for each instance of the scene.
void passes_draw_list_upload_previous(draw_list *list, const filter_context *context,
                                      const float (*transforms)[16]);

uint32_t passes_batch_index_count(const device_scene *scene, const instance_batch *batch);
/// The buffer of struct vertex that a batch draws.
lobe_resource passes_batch_vertices(const filter_context *context, const instance_batch *batch);
/// The buffer of struct instance_constants, from the batch's first on, that it draws for a view.
lobe_resource passes_batch_transforms(const instance_batch *batch, draw_view view);
/// Sets the indices of a draw, how many there are, and how many instances.
void passes_batch_set_counts(const filter_context *context, const instance_batch *batch,
                             draw_view view, lobe_draw *draw);
/// Of the height map, the object's lengths, if the filter's slopes follow how it is stretched; 0:
/// they do not.
float passes_batch_map_width(const filter_context *context, const instance_batch *batch);
lobe_cull passes_batch_cull(const device_scene *scene, const instance_batch *batch);

#endif
