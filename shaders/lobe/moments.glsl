// The filter "moments", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/moments.glsl"
#include "lobe/shading.glsl"
