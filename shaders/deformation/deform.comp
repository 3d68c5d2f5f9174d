#version 460
#extension GL_GOOGLE_include_directive : require

// The vertices of a mesh in a pose: morph targets, then joints. glTF 2.0, sections 3.7.2.2 and
// 3.7.3. Normals are transformed by the inverse transpose of the blended matrix, and tangents by
// the matrix itself; a matrix that mirrors flips their handedness.

#include "interface/deformation.h"
#include "interface/instance.h"
#include "interface/vertex.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, std430) readonly buffer base_block { vertex base[]; };
layout(set = 0, binding = 1, std430) readonly buffer influence_block {
    joint_influence influences[];
};
layout(set = 0, binding = 2, std430) readonly buffer joint_block { mat4 joints[]; };
layout(set = 0, binding = 3, std430) readonly buffer first_delta_block { uint first_deltas[]; };
layout(set = 0, binding = 4, std430) readonly buffer delta_block { morph_delta deltas[]; };
layout(set = 0, binding = 5, std430) readonly buffer weight_block { float weights[]; };
layout(set = 0, binding = 6, std430) writeonly buffer deformed_block { vertex deformed[]; };

layout(push_constant) uniform constants_block { deform_constants mesh; };

instance_constants instance;

#include "shading/instance_transform.glsl"

struct surface_point {
    vec3 position, normal;
    vec4 tangent;
};

vec3 vector(float v[3]) {
    return vec3(v[0], v[1], v[2]);
}

surface_point morphed(uint index) {
    vertex v = base[index];
    surface_point point;
    point.position = vector(v.position);
    point.normal = vector(v.normal);
    point.tangent = vec4(v.tangent[0], v.tangent[1], v.tangent[2], v.tangent[3]);
    if (mesh.targets == 0u)
        return point;
    for (uint i = first_deltas[index]; i < first_deltas[index + 1u]; i++) {
        morph_delta delta = deltas[i];
        float weight = weights[delta.target];
        point.position += weight * vector(delta.position);
        point.normal += weight * vector(delta.normal);
        point.tangent.xyz += weight * vector(delta.tangent);
    }
    return point;
}

// Sets `instance` to the mean of the joints' matrices. False: the mesh has none.
bool blend_joints(uint index) {
    if (mesh.influences == 0u)
        return false;
    mat4 blended = mat4(0.0);
    for (uint i = 0u; i < mesh.influences; i++) {
        joint_influence influence = influences[index * mesh.influences + i];
        if (influence.weight != 0.0)
            blended += influence.weight * joints[influence.joint];
    }
    mat4 rows = transpose(blended);
    for (int row = 0; row < 3; row++)
        instance.rows[row] = rows[row];
    return true;
}

vec3 deformed_position(uint index) {
    vec3 position = morphed(index).position;
    return blend_joints(index) ? transform_point(position) : position;
}

// `v` at unit length; `otherwise` if it has no direction. Its squares may be out of range.
vec3 unit(vec3 v, vec3 otherwise) {
    float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return size > 0.0 && size < 3e38 ? normalize(v / size) : otherwise;
}

// Of three vertices that are a triangle of their own.
vec3 facet_normal(uint index, vec3 otherwise) {
    uint first = index - index % 3u;
    vec3 origin = deformed_position(first);
    vec3 a = deformed_position(first + 1u) - origin, b = deformed_position(first + 2u) - origin;
    float size = max(max(max(abs(a.x), abs(a.y)), abs(a.z)),
                     max(max(abs(b.x), abs(b.y)), abs(b.z)));
    return size > 0.0 ? unit(cross(a / size, b / size), otherwise) : otherwise;
}

// The tangent in the plane of the normal; any direction there if nothing of it is left.
vec3 orthonormal(vec3 tangent, vec3 normal) {
    vec3 along = unit(tangent, vec3(0.0));
    vec3 flat_part = along - dot(along, normal) * normal;
    vec3 axis = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    return dot(flat_part, flat_part) > 1e-8 ? normalize(flat_part)
                                            : normalize(cross(axis, normal));
}

surface_point deformed_point(uint index) {
    surface_point point = morphed(index);
    vec3 rest = vector(base[index].normal);
    point.normal = unit(point.normal, rest);
    if (blend_joints(index)) {
        point.position = transform_point(point.position);
        vec3 normal = transform_normal(point.normal);
        // A matrix that flattens everything leaves none: the comparison is false for NaN.
        point.normal = dot(normal, normal) > 0.5 ? normalize(normal) : point.normal;
        point.tangent = transform_tangent(point.tangent);
    }
    if (mesh.faceted != 0u)
        point.normal = facet_normal(index, point.normal);
    point.tangent.xyz = orthonormal(point.tangent.xyz, point.normal);
    return point;
}

void main() {
    uint index = gl_GlobalInvocationID.y * mesh.row + gl_GlobalInvocationID.x;
    if (gl_GlobalInvocationID.x >= mesh.row || index >= mesh.vertex_count)
        return;
    surface_point point = deformed_point(index);
    vertex v = base[index];
    for (int i = 0; i < 3; i++) {
        v.position[i] = point.position[i];
        v.normal[i] = point.normal[i];
        v.tangent[i] = point.tangent[i];
    }
    v.tangent[3] = point.tangent.w;
    deformed[index] = v;
}
