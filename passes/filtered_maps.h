#ifndef PASSES_FILTERED_MAPS_H
#define PASSES_FILTERED_MAPS_H

#include "passes/filter.h"

/// Adds what shaders/filtered_maps.glsl reads: the colour maps of a material, filtered linearly
/// (each image once for all materials), and the knobs of the footprint.
void filtered_maps_build(const filter_context *context, uint32_t material,
                         filtered_appearance *appearance);

/// Size of the maps that lobes come from: the larger of the normal and the width map, in texels.
/// False where the material has neither.
bool lobe_map_extent(const device_material *material, uint32_t *width, uint32_t *height);

/// The storage format of filtered maps that the knob "storage" asks for.
lobe_format filtered_map_format(const filter_context *context);

/// Trilinear, wrapping as the material's map does.
lobe_sampler filtered_map_sampler(const device_material *material, uint32_t map);

/// Knobs of all filters that read filtered maps: put them last in a filter's list.
extern const char *const storage_choices[];
#define FILTERED_MAP_KNOBS                                                                         \
    {                                                                                              \
        "probes",                                                                                  \
        "samples along the longer axis of a pixel's footprint",                                    \
        LOBE_KNOB_INTEGER,                                                                         \
        1,                                                                                         \
        16,                                                                                        \
        1,                                                                                         \
        NULL},                                                                                     \
        {"bias",                                                                                   \
         "added to the MIP level: below 0 sharper, above 0 smoother",                              \
         LOBE_KNOB_NUMBER,                                                                         \
         -2,                                                                                       \
         2,                                                                                        \
         0,                                                                                        \
         NULL},                                                                                    \
    {                                                                                              \
        "storage", "format of filtered maps", LOBE_KNOB_CHOICE, 0, 1, 0, storage_choices           \
    }

#endif
