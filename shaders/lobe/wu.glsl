// The filter "wu", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/wu.glsl"
#include "lobe/shading.glsl"
