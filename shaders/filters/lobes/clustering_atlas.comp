#version 460
#extension GL_GOOGLE_include_directive : require

// The finest level of a map of lobe mixtures in object or camera space: like clustering.comp, with
// each texel's tangent frame from the mesh's surface atlas. Texels that face away from the camera
// are left out (Xu et al. 2017, section 4, Generation of instant BRDF map).

#include "interface/clustering_atlas.h"
#include "filters/lobes/clustering.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 17) uniform sampler2D atlas_normal;   // xyz, coverage
layout(set = 0, binding = 18) uniform sampler2D atlas_tangent;  // xyz, handedness
layout(set = 0, binding = 19) uniform sampler2D atlas_position; // xyz

layout(push_constant) uniform constants_block { atlas_constants constants; };

mat3 rotation() {
    return transpose(mat3(constants.rotation[0].xyz, constants.rotation[1].xyz,
                          constants.rotation[2].xyz));
}

bool faces_away(vec3 normal, ivec2 texel) {
    if (constants.eye.w < 0.0)
        return false;
    vec3 to_eye = constants.eye.xyz - texelFetch(atlas_position, texel, 0).xyz * constants.eye.w;
    return dot(normal, to_eye) <= 0.0;
}

void main() {
    ivec2 position = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(position, imageSize(mixture_map).xy)))
        return;
    target_points points = points_under(position, ivec2(constants.width, constants.height));
    cluster_sums sums = no_lobes();
    float complements[MATERIAL_MAXIMUM_LOBES];
    if (!has_map(MAP_WIDTH))
        base_complements(material.width_factor, complements);
    if (WEIGHTED)
        read_colours(points);
    for (int i = 0; i < texel_count(points); ++i) {
        ivec2 texel = points.first + texel_of(points, i);
        vec4 surface_normal = texelFetch(atlas_normal, texel, 0);
        if (surface_normal.w == 0.0 || faces_away(surface_normal.xyz, texel))
            continue;
        vec4 tangent = texelFetch(atlas_tangent, texel, 0);
        vec3 bitangent = tangent.w * cross(surface_normal.xyz, tangent.xyz);
        mat3 from_tangent = mat3(tangent.xyz, bitangent, surface_normal.xyz);
        mat3 to_mixture = rotation() * from_tangent;
        for (int point = 0; point < POINTS; ++point)
            add_point(sums, point_of(points, i * POINTS + point), to_mixture,
                      vec2(constants.alpha, constants.cutoff), complements);
    }
    store_clusters(position, sums);
}
