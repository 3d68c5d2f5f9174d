// The filter "leadr", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/leadr.glsl"
#include "lobe/shading.glsl"
