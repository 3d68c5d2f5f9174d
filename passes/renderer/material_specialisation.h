#ifndef PASSES_RENDERER_MATERIAL_SPECIALISATION_H
#define PASSES_RENDERER_MATERIAL_SPECIALISATION_H

#include <lobe/graph.h>

#include "passes/upload/device_scene.h"

#define MAXIMUM_SPECIALISATIONS 96

typedef struct specialisation_list {
    lobe_graph *graph; ///< where an overflow is reported: the frame fails
    lobe_specialisation items[MAXIMUM_SPECIALISATIONS];
    size_t count;
} specialisation_list;

void passes_specialise(specialisation_list *list, uint32_t id, uint32_t bits);

/// What the shaders compile out for a material: maps, lobes and features that it lacks.
void passes_material_specialise(const device_material *material, specialisation_list *list);

#endif
