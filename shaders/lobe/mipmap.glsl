// The filter "mipmap", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/mipmap.glsl"
#include "lobe/shading.glsl"
