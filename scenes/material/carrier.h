#ifndef SCENES_MATERIAL_CARRIER_H
#define SCENES_MATERIAL_CARRIER_H

#include <lobe/host.h>
#include <lobe/result.h>
#include <lobe/scene.h>

/// Adds the carrier of a material to a scene, with its camera and lights. The scene must already
/// have its first material and images.
lobe_result scenes_carrier_add(lobe_scene *scene, lobe_carrier carrier, const lobe_host *host);

#endif
