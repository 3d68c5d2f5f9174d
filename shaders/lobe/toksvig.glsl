// The filter "toksvig", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/toksvig.glsl"
#include "lobe/shading.glsl"
