#ifndef INSTANCE_TRANSFORM_GLSL
#define INSTANCE_TRANSFORM_GLSL

// From object to world space, by the push constants of the draw.

mat3 object_to_world_linear() {
    return transpose(mat3(instance.rows[0].xyz, instance.rows[1].xyz, instance.rows[2].xyz));
}

vec3 transform_point(vec3 position) {
    vec4 p = vec4(position, 1.0);
    return vec3(dot(instance.rows[0], p), dot(instance.rows[1], p), dot(instance.rows[2], p));
}

// Normals are transformed by the cofactor matrix, det(M) M^-T, which exists for any M.
vec3 transform_normal(vec3 normal) {
    vec3 r0 = instance.rows[0].xyz, r1 = instance.rows[1].xyz, r2 = instance.rows[2].xyz;
    vec3 n = vec3(dot(cross(r1, r2), normal), dot(cross(r2, r0), normal), dot(cross(r0, r1), normal));
    float handedness = dot(r0, cross(r1, r2)) < 0.0 ? -1.0 : 1.0;
    return handedness * normalize(n);
}

vec4 transform_tangent(vec4 tangent) {
    mat3 linear = object_to_world_linear();
    float handedness = determinant(linear) < 0.0 ? -1.0 : 1.0;
    return vec4(linear * tangent.xyz, handedness * tangent.w);
}

#endif
