// The filter "lean", for shaders of hosts.

#include "lobe/surface.glsl"
#include "filters/lean.glsl"
#include "lobe/shading.glsl"
