#include "scenes/animation/posed_numbers.h"

#include <math.h>
#include <string.h>

static const struct path_entry {
    channel_owner owner;
    size_t width, offset; ///< values of a key; bytes into the numbers, or into a lobe_map_place
} paths[LOBE_CHANNEL_PATH_COUNT] = {
#define OF_NODE(width)                                                                             \
    { CHANNEL_OF_NODE, width, 0 }
#define OF_MATERIAL(width, member)                                                                 \
    { CHANNEL_OF_MATERIAL, width, offsetof(lobe_material_numbers, member) }
#define OF_MAP(width, member)                                                                      \
    { CHANNEL_OF_MATERIAL, width, offsetof(lobe_map_place, member) }
#define OF_LIGHT(width, member)                                                                    \
    { CHANNEL_OF_LIGHT, width, offsetof(lobe_light_numbers, member) }
    [LOBE_CHANNEL_TRANSLATION] = OF_NODE(3),
    [LOBE_CHANNEL_ROTATION] = OF_NODE(4),
    [LOBE_CHANNEL_SCALE] = OF_NODE(3),
    [LOBE_CHANNEL_WEIGHTS] = OF_NODE(0),
    [LOBE_CHANNEL_BASE_COLOUR] = OF_MATERIAL(4, base_colour),
    [LOBE_CHANNEL_METALLIC] = OF_MATERIAL(1, metallic),
    [LOBE_CHANNEL_ROUGHNESS] = OF_MATERIAL(1, roughness),
    [LOBE_CHANNEL_EMISSIVE] = OF_MATERIAL(3, emissive),
    [LOBE_CHANNEL_EMISSIVE_STRENGTH] = OF_MATERIAL(1, emissive_strength),
    [LOBE_CHANNEL_NORMAL_SCALE] = OF_MATERIAL(1, normal_scale),
    [LOBE_CHANNEL_OCCLUSION_STRENGTH] = OF_MATERIAL(1, occlusion_strength),
    [LOBE_CHANNEL_ALPHA_CUTOFF] = OF_MATERIAL(1, alpha_cutoff),
    [LOBE_CHANNEL_MAP_OFFSET] = OF_MAP(2, offset),
    [LOBE_CHANNEL_MAP_ROTATION] = OF_MAP(1, rotation),
    [LOBE_CHANNEL_MAP_SCALE] = OF_MAP(2, scale),
    [LOBE_CHANNEL_LIGHT_COLOUR] = OF_LIGHT(3, colour),
    [LOBE_CHANNEL_LIGHT_INTENSITY] = OF_LIGHT(1, intensity),
    [LOBE_CHANNEL_LIGHT_RANGE] = OF_LIGHT(1, range),
    [LOBE_CHANNEL_LIGHT_INNER_CONE] = OF_LIGHT(1, inner_cone),
    [LOBE_CHANNEL_LIGHT_OUTER_CONE] = OF_LIGHT(1, outer_cone),
};

channel_owner scenes_channel_owner(lobe_channel_path path) {
    return paths[path].owner;
}

size_t scenes_channel_width(lobe_channel_path path) {
    return paths[path].width;
}

static bool is_of_map(lobe_channel_path path) {
    return path >= LOBE_CHANNEL_MAP_OFFSET && path <= LOBE_CHANNEL_MAP_SCALE;
}

float *scenes_posed_numbers(const lobe_animation_channel *channel, void *numbers) {
    char *base = numbers;
    if (is_of_map(channel->path))
        base = (char *)&((lobe_material_numbers *)numbers)->maps[channel->map];
    return (float *)(void *)(base + paths[channel->path].offset);
}

static uint32_t part_of_map(uint32_t map) {
    return UINT32_C(1) << (LOBE_CHANNEL_PATH_COUNT + map);
}

uint32_t scenes_posed_part(const lobe_animation_channel *channel) {
    return is_of_map(channel->path) ? part_of_map(channel->map) : UINT32_C(1) << channel->path;
}

// ---------------------------------------------------------------------------------------------
// Materials

// Beyond it, products overflow.
static const float largest = 1e6f;

static float clamp(float value, float least, float most) {
    return value > least ? fminf(value, most) : least; // NaN is the least
}

bool scenes_map_transform(const double offset[2], double rotation, const double scale[2],
                          float transform[2][3]) {
    const double c = cos(rotation), s = sin(rotation);
    const double rows[2][3] = {{c * scale[0], s * scale[1], offset[0]},
                               {-s * scale[0], c * scale[1], offset[1]}};
    bool finite = true;
    for (int row = 0; row < 2; row++) {
        for (int column = 0; column < 3; column++) {
            transform[row][column] = (float)rows[row][column];
            finite = finite && isfinite(transform[row][column]);
        }
    }
    return finite;
}

static void place_map(const lobe_map_place *place, lobe_texture_use *use) {
    float transform[2][3];
    const double offset[2] = {place->offset[0], place->offset[1]},
                 scale[2] = {place->scale[0], place->scale[1]};
    if (scenes_map_transform(offset, place->rotation, scale, transform))
        memcpy(use->transform, transform, sizeof transform);
}

static void place_maps(const lobe_material_numbers *numbers, uint32_t parts, lobe_material *to) {
    lobe_texture_use *const uses[LOBE_POSED_MAP_COUNT] = {
        [LOBE_POSED_BASE_COLOUR_MAP] = &to->base_colour_map,
        [LOBE_POSED_NORMAL_MAP] = &to->normal_map,
        [LOBE_POSED_METALLIC_ROUGHNESS_MAP] = &to->metallic_roughness_map,
        [LOBE_POSED_EMISSIVE_MAP] = &to->emissive_map,
        [LOBE_POSED_OCCLUSION_MAP] = &to->occlusion_map,
    };
    for (uint32_t map = 0; map < LOBE_POSED_MAP_COUNT; map++)
        if (parts & part_of_map(map))
            place_map(&numbers->maps[map], uses[map]);
}

static void set_emission(const lobe_material_numbers *numbers, lobe_material *to) {
    for (int i = 0; i < 3; i++)
        to->emissive[i] = clamp(numbers->emissive[i] * numbers->emissive_strength, 0, largest);
}

static void set_factors(const lobe_material_numbers *numbers, uint32_t parts, lobe_material *to) {
    const struct {
        lobe_channel_path path;
        float from, *to, least, most;
    } factors[] = {
        {LOBE_CHANNEL_METALLIC, numbers->metallic, &to->metallic, 0, 1},
        {LOBE_CHANNEL_ROUGHNESS, numbers->roughness, &to->roughness, 0, 1},
        {LOBE_CHANNEL_NORMAL_SCALE, numbers->normal_scale, &to->normal_scale, -largest, largest},
        {LOBE_CHANNEL_OCCLUSION_STRENGTH, numbers->occlusion_strength, &to->occlusion_strength, 0,
         1},
        {LOBE_CHANNEL_ALPHA_CUTOFF, numbers->alpha_cutoff, &to->alpha_cutoff, 0, largest},
    };
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++)
        if (parts & UINT32_C(1) << factors[i].path)
            *factors[i].to = clamp(factors[i].from, factors[i].least, factors[i].most);
}

bool scenes_posed_material_set(const lobe_material_numbers *numbers, uint32_t parts,
                               lobe_material *material) {
    const uint32_t emission =
        UINT32_C(1) << LOBE_CHANNEL_EMISSIVE | UINT32_C(1) << LOBE_CHANNEL_EMISSIVE_STRENGTH;
    const lobe_material before = *material;
    for (int i = 0; (parts & UINT32_C(1) << LOBE_CHANNEL_BASE_COLOUR) && i < 4; i++)
        material->base_colour[i] = clamp(numbers->base_colour[i], 0, 1);
    if (parts & emission)
        set_emission(numbers, material);
    set_factors(numbers, parts, material);
    place_maps(numbers, parts, material);
    return memcmp(&before, material, sizeof before) != 0;
}

// ---------------------------------------------------------------------------------------------
// Lights

void scenes_posed_light_set(const lobe_light_numbers *numbers, uint32_t parts, lobe_light *light) {
    const uint32_t colour =
        UINT32_C(1) << LOBE_CHANNEL_LIGHT_COLOUR | UINT32_C(1) << LOBE_CHANNEL_LIGHT_INTENSITY;
    const uint32_t cone =
        UINT32_C(1) << LOBE_CHANNEL_LIGHT_INNER_CONE | UINT32_C(1) << LOBE_CHANNEL_LIGHT_OUTER_CONE;
    for (int i = 0; (parts & colour) && i < 3; i++)
        light->intensity[i] = clamp(numbers->colour[i] * numbers->intensity, 0, 1e18f);
    if ((parts & UINT32_C(1) << LOBE_CHANNEL_LIGHT_RANGE) && light->type != LOBE_LIGHT_DIRECTIONAL)
        light->range = clamp(numbers->range, 0, 1e18f);
    if (!(parts & cone) || light->type != LOBE_LIGHT_SPOT)
        return;
    light->outer_cone = clamp(numbers->outer_cone, 1e-4f, (float)M_PI / 2);
    light->inner_cone = clamp(numbers->inner_cone, 0, nextafterf(light->outer_cone, 0));
}
