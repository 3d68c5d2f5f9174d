#ifndef PASSES_RENDERER_CULLING_CULLING_H
#define PASSES_RENDERER_CULLING_CULLING_H

#include "passes/renderer/draw_list.h"

/// Leaves out instances that no pixel of the picture can show, on the device: adds passes that find
/// the others, if the list has so many triangles that it pays, and lets its batches be drawn from
/// what they find (`seen`). Samples may lie anywhere in their pixels. After
/// passes_draw_list_end.
void passes_culling(const filter_context *context, draw_list *list);

#endif
