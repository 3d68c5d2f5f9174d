// The filter "tan", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/tan.glsl"
#include "lobe/shading.glsl"
