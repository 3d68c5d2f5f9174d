// The filter "direct", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/direct.glsl"
#include "lobe/shading.glsl"
