#ifndef INSTANCE_TRANSFORM_GLSL
#define INSTANCE_TRANSFORM_GLSL

// From object to world space, by the transform of `instance`.

mat3 object_to_world_linear() {
    return transpose(mat3(instance.rows[0].xyz, instance.rows[1].xyz, instance.rows[2].xyz));
}

vec3 transform_point(vec3 position) {
    vec4 p = vec4(position, 1.0);
    return vec3(dot(instance.rows[0], p), dot(instance.rows[1], p), dot(instance.rows[2], p));
}

// Normals are transformed by the cofactor matrix, det(M) M^-T, which exists for any M. Only its
// direction counts, so M is taken over its largest element: its products are in range at any scale.
mat3 cofactors() {
    vec3 r0 = instance.rows[0].xyz, r1 = instance.rows[1].xyz, r2 = instance.rows[2].xyz;
    vec3 largest = max(max(abs(r0), abs(r1)), abs(r2));
    float size = max(max(largest.x, largest.y), largest.z);
    r0 /= size, r1 /= size, r2 /= size;
    return mat3(cross(r1, r2), cross(r2, r0), cross(r0, r1));
}

// The sign of the determinant of M.
float handedness(mat3 cofactors_of_rows) {
    return dot(instance.rows[0].xyz, cofactors_of_rows[0]) < 0.0 ? -1.0 : 1.0;
}

vec3 transform_normal(vec3 normal) {
    mat3 rows = cofactors();
    return handedness(rows) * normalize(normal * rows);
}

// How thick a layer becomes, over its thickness before, on a surface with a normal of any length:
// |det M| over the factor by which its area grows.
float thickness(vec3 normal) {
    vec3 r0 = instance.rows[0].xyz, r1 = instance.rows[1].xyz, r2 = instance.rows[2].xyz;
    vec3 largest = max(max(abs(r0), abs(r1)), abs(r2));
    float size = max(max(largest.x, largest.y), largest.z);
    mat3 rows = cofactors();
    return size * abs(dot(r0 / size, rows[0])) / max(length(normalize(normal) * rows), 1e-30);
}

vec4 transform_tangent(vec4 tangent) {
    return vec4(object_to_world_linear() * tangent.xyz, handedness(cofactors()) * tangent.w);
}

#endif
