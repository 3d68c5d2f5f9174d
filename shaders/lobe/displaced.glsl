// The filter "displaced", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/displaced.glsl"
#include "lobe/shading.glsl"
