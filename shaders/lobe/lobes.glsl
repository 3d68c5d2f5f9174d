// The filter "lobes", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/lobes.glsl"
#include "lobe/shading.glsl"
