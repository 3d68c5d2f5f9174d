#ifndef INTERFACE_LIGHT_H
#define INTERFACE_LIGHT_H

#include "types.h"

// A uniform buffer of 4 KiB, whether there are so many or not: few scenes have more lights.
#define LIGHTS_PER_PASS 64

// A punctual light (std140).
struct light {
    float4 position;  // world; w: 1 / range^2, 0 for unlimited
    float4 direction; // unit, towards the light for directional ones, else where a spot points
    float4 intensity; // linear RGB, candela or lux
    // Spot: x scale, y offset of the angular attenuation. With a shadow: z its first view, w how
    // many views (0: none).
    float4 cone;
};
INTERFACE_SIZE(light, 64)
INTERFACE_OFFSET(light, direction, 16)
INTERFACE_OFFSET(light, intensity, 32)
INTERFACE_OFFSET(light, cone, 48)

#endif
