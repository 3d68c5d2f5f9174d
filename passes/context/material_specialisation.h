#ifndef PASSES_CONTEXT_MATERIAL_SPECIALISATION_H
#define PASSES_CONTEXT_MATERIAL_SPECIALISATION_H

#include <lobe/graph.h>

#include "passes/upload/device_scene.h"

#define MAXIMUM_SPECIALISATIONS 96

typedef struct specialisation_list {
    lobe_graph *graph; ///< an overflow fails this graph's frame
    lobe_specialisation items[MAXIMUM_SPECIALISATIONS];
    size_t count;
} specialisation_list;

void passes_specialise(specialisation_list *list, uint32_t id, uint32_t bits);

/// Whether a material emits light, before its map of that.
bool passes_material_emits(const device_material *material);
/// Sets the constants that compile out maps, lobes and features that a material lacks.
void passes_material_specialise(const device_material *material, specialisation_list *list);
/// Those of them on which its lobes depend. `map_bits`: of the maps that the shader may read.
void passes_lobes_specialise(const device_material *material, uint32_t map_bits,
                             specialisation_list *list);

#endif
