#ifndef SCENES_ANIMATION_POSED_NUMBERS_H
#define SCENES_ANIMATION_POSED_NUMBERS_H

#include <lobe/scene.h>

/// Numbers of materials and lights that channels move: a table of where each is.

typedef enum channel_owner { CHANNEL_OF_NODE, CHANNEL_OF_MATERIAL, CHANNEL_OF_LIGHT } channel_owner;

channel_owner scenes_channel_owner(lobe_channel_path path);
/// Values of a key; 0: as many as the node has morph targets.
size_t scenes_channel_width(lobe_channel_path path);

/// The channel's numbers in those of its material or light. `numbers`: a lobe_material_numbers or
/// lobe_light_numbers, as the owner of its path says.
float *scenes_posed_numbers(const lobe_animation_channel *channel, void *numbers);

/// What a channel moves, as a bit; of maps, one for each.
uint32_t scenes_posed_part(const lobe_animation_channel *channel);
/// Sets the parts of a material or a light, clamped to their ranges, and leaves the others alone.
/// Returns whether the material is another then.
bool scenes_posed_material_set(const lobe_material_numbers *numbers, uint32_t parts,
                               lobe_material *material);
void scenes_posed_light_set(const lobe_light_numbers *numbers, uint32_t parts, lobe_light *light);

/// KHR_texture_transform: T(offset) R(rotation) S(scale), where a positive rotation turns the
/// coordinates counter-clockwise as seen in the image, whose v runs downwards. False if the result
/// is not finite in single precision.
bool scenes_map_transform(const double offset[2], double rotation, const double scale[2],
                          float transform[2][3]);

#endif
