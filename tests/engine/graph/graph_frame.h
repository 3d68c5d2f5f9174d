#ifndef TESTS_ENGINE_GRAPH_GRAPH_FRAME_H
#define TESTS_ENGINE_GRAPH_GRAPH_FRAME_H

#include <lobe/device.h>
#include <lobe/vulkan.h>

/// A frame like a renderer's, with everything that a graph supports: compute passes along MIP
/// chains and from buffer to buffer, sums over frames, raster passes of many draws, transfers; on
/// imported, retained and transient images and buffers, with uploads and data that is read back.
/// Images are small: the tests look at the work of the host, not of the device.

#define GRAPH_FRAME_PASSES   50 ///< that run, without those that read back
#define GRAPH_FRAME_TEXTURES 4

typedef struct graph_frame {
    lobe_device *device; ///< not owned; knows the test shaders
    lobe_graph *graph;
    lobe_texture *textures[GRAPH_FRAME_TEXTURES];
    lobe_buffer *vertices, *indices;
    const lobe_vulkan_image *target; ///< one more pass draws into it; NULL: none
    float time;                      ///< uploaded; passes that depend on it run again
    lobe_resource mean;              ///< read back: a buffer of 64 floats, `time` + 16 + n
} graph_frame;

lobe_result graph_frame_open(lobe_device *device, graph_frame *frame);
void graph_frame_close(graph_frame *frame);

/// Begins a frame and declares all of it.
void graph_frame_declare(graph_frame *frame);

#endif
