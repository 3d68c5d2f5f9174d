#ifndef PASSES_RENDERER_CULLING_CULLING_H
#define PASSES_RENDERER_CULLING_CULLING_H

#include "passes/renderer/draw_list.h"

/// Leaves out instances that no pixel of the picture can show, on the device: adds passes that find
/// the others, if the list has so many triangles that it pays, and lets its batches be drawn from
/// what they find (`seen`). Samples may lie anywhere in their pixels. After
/// passes_draw_list_end.
void passes_culling(const filter_context *context, draw_list *list);

/// The same for the transforms that these instances had in the previous frame, after
/// passes_draw_list_upload_previous and passes_culling.
void passes_culling_of_previous(const filter_context *context, draw_list *list);

/// Leaves out instances that no texel of a shadow map can show, in the place of those that an
/// earlier one left out. `extent`: of the map, texels a side.
void passes_culling_for_light(const filter_context *context, draw_list *list,
                              const float world_to_clip[16], uint32_t extent);

#endif
