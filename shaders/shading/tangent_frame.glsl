#ifndef TANGENT_FRAME_GLSL
#define TANGENT_FRAME_GLSL

// Gram-Schmidt on the interpolated normal and tangent; any frame where they are parallel. The
// tangent has the length that the instance's transform gives it.
mat3 tangent_frame(vec3 normal, vec4 tangent) {
    vec3 n = normalize(normal);
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    float size = dot(t, t);
    if (!(size > 1e-12 * dot(tangent.xyz, tangent.xyz))) {
        t = abs(n.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        t -= n * dot(n, t);
        size = dot(t, t);
    }
    t *= inversesqrt(size);
    return mat3(t, (tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, t), n);
}

#endif
