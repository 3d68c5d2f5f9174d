// The filter "multi_leadr", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/multi_leadr.glsl"
#include "lobe/shading.glsl"
