// The filter "fournier", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/fournier.glsl"
#include "lobe/shading.glsl"
