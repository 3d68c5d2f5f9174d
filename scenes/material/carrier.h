#ifndef SCENES_MATERIAL_CARRIER_H
#define SCENES_MATERIAL_CARRIER_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Adds the carrier of a material to a scene, with its camera. The scene must already have its
/// first material and images.
lobe_result scenes_carrier_add(lobe_scene *scene, lobe_carrier carrier, const lobe_host *host);

/// Turns an added sky: behind a plane, to the side opposite the camera for a cloth, so that
/// highlights lie between sun and camera; for a sphere to the front.
void scenes_carrier_turn_light(lobe_scene *scene, lobe_carrier carrier);

#endif
