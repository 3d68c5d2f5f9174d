#ifndef NO_GATHERING_GLSL
#define NO_GATHERING_GLSL

// For filters whose lights share nothing but the appearance that they fetch. Included after it.

void gather_lights(inout appearance fetched, surface_point surface, vec3 incoming[4]) {
}

#endif
