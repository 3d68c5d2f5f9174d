#ifndef RELIEF_SURFACE_GLSL
#define RELIEF_SURFACE_GLSL

// What the filters of reliefs share: who looks, what is drawn, and where light comes from.

#include "shading/base_material.glsl"

layout(constant_id = SPECIALISE_RELIEF) const bool RELIEF = false;

// Radiance towards a viewer nearer to the horizon than this is that of a viewer there.
const float LEAST_HEIGHT = 0.02;
// Cells that the viewer hardly sees count as showing at least this part of the mean visible area,
// as a ratio of two small numbers is not reliable: some cells of a white furnace were black.
const float LEAST_VISIBLE = 0.15;

vec3 viewer_of(surface_point surface) {
    vec3 viewer = surface.outgoing;
    viewer.z = max(viewer.z, LEAST_HEIGHT);
    return normalize(viewer);
}

// Whether a relief reflects diffuse light.
bool has_diffuse() {
    return RELIEF && (MODEL == MODEL_MICROFACET || DIFFUSE);
}

#ifdef ENVIRONMENT
mat3 tangent_from_environment_of(surface_point surface) {
    return transpose(mat3(to_environment(surface, vec3(1.0, 0.0, 0.0)),
                          to_environment(surface, vec3(0.0, 1.0, 0.0)),
                          to_environment(surface, vec3(0.0, 0.0, 1.0))));
}

// The level of the environment whose faces are so many texels wide.
int level_of_faces(int width) {
    return max(findMSB(textureSize(environment_faces, 0).x / width), 0);
}
#endif

#endif
