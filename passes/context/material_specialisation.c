#include "passes/context/material_specialisation.h"

#include <assert.h>

#include "passes/upload/material_maps.h"
#include "shaders/interface/specialisation.h"

static_assert(LOBE_MATERIAL_MICROFACET == MODEL_MICROFACET, "one list of models");
static_assert(LOBE_MATERIAL_HALF_VECTOR_LOBES == MODEL_HALF_VECTOR_LOBES, "one list of models");
static_assert(LOBE_DISTRIBUTION_GGX == DISTRIBUTION_GGX, "one list of distributions");
static_assert(LOBE_DISTRIBUTION_BECKMANN == DISTRIBUTION_BECKMANN, "one list of distributions");
static_assert(LOBE_DISTRIBUTION_BLINN_PHONG == DISTRIBUTION_BLINN_PHONG,
              "one list of distributions");
static_assert(LOBE_DISTRIBUTION_VMF == DISTRIBUTION_VMF, "one list of distributions");

static_assert((int)LOBE_NORMALS_UNSIGNED == NORMALS_UNSIGNED, "one list of encodings");
static_assert((int)LOBE_NORMALS_SIGNED == NORMALS_SIGNED, "one list of encodings");
static_assert((int)LOBE_NORMALS_UNSIGNED_XY == NORMALS_UNSIGNED_XY, "one list of encodings");
static_assert((int)LOBE_NORMALS_SIGNED_XY == NORMALS_SIGNED_XY, "one list of encodings");

void passes_specialise(specialisation_list *list, uint32_t id, uint32_t bits) {
    if (list->count == MAXIMUM_SPECIALISATIONS) {
        lobe_graph_fail(list->graph, LOBE_ERROR_LIMIT,
                        "specialisation constant %u comes after %d others, which is the limit", id,
                        MAXIMUM_SPECIALISATIONS);
        return;
    }
    list->items[list->count++] = (lobe_specialisation){id, bits};
}

static bool any(const float colour[3]) {
    return colour[0] > 0 || colour[1] > 0 || colour[2] > 0;
}

bool passes_material_emits(const device_material *material) {
    return any(material->material->emissive);
}

void passes_material_specialise(const device_material *material, specialisation_list *list) {
    passes_lobes_specialise(material, material->map_bits, list);
    passes_specialise(list, SPECIALISE_DIFFUSE, any(material->material->base_colour));
    passes_specialise(list, SPECIALISE_EMISSION, passes_material_emits(material));
}

void passes_lobes_specialise(const device_material *material, uint32_t map_bits,
                             specialisation_list *list) {
    const lobe_material *source = material->material;
    passes_specialise(list, SPECIALISE_MODEL, source->model);
    passes_specialise(list, SPECIALISE_DISTRIBUTION, source->distribution);
    passes_specialise(list, SPECIALISE_LOBE_COUNT, material->lobe_count);
    passes_specialise(list, SPECIALISE_MAPS, map_bits);
    passes_specialise(list, SPECIALISE_SECOND_COORDINATES, passes_second_coordinates(material));
    passes_specialise(list, SPECIALISE_NORMALS, material->maps[MAP_NORMAL].normals);
    passes_specialise(list, SPECIALISE_NORMAL_CONCENTRATION, source->normal_concentration > 0);
    passes_specialise(list, SPECIALISE_ALPHA_MASK, material->masked);
    passes_specialise(list, SPECIALISE_METALLIC_MAP, material->metallic_varies);
}
