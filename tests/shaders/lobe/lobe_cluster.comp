#version 460
#extension GL_GOOGLE_include_directive : require

#include "support/harness.glsl"
#include "lib/lobe/lobe_cluster.glsl"

vec4 evaluate(vec4 a, vec4 b, vec4 c) {
    return vec4(cluster_of(a.xyz, CLUSTERS_TURNED), sector_of(a.xyz, CLUSTERS_TURNED),
                cluster_of(a.xyz, CLUSTERS_PAPER), SECTOR_COUNT);
}
