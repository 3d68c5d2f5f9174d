#ifndef LIB_LOBE_CLUSTER_GLSL
#define LIB_LOBE_CLUSTER_GLSL

#include "interface/cluster.h"

// The partition of directions about the pole (0, 0, 1) into clusters of lobes: Xu, Wang, Zhao,
// Bao, 2017, Real-Time Linear BRDF MIP-Mapping, sections 3.2 and 4. Subdivision 0 has one cluster,
// subdivision 1 has 4 sectors of longitude, subdivision 2 splits each by latitude: cluster j of
// subdivision 2 lies in sector j/2 (Algorithm 1 means children 2i and 2i + 1).
//
// Sectors are centred on +x, +y, -x, -y and meet on the diagonals: structures woven or tiled along
// a texture's axes have normals that lean along them, and noise should not split their lobes.

// The paper's sectors begin at the axes instead (CLUSTERS_PAPER).

const uint CLUSTER_COUNT = 8u;
const uint SECTOR_COUNT = 4u;

uint quadrant_of(vec3 direction) {
    return direction.y < 0.0 ? (direction.x < 0.0 ? 2u : 3u) : (direction.x < 0.0 ? 1u : 0u);
}

uint sector_of(vec3 direction, uint clusters) {
    if (clusters == CLUSTERS_PAPER)
        return quadrant_of(direction);
    bool along_x = abs(direction.x) >= abs(direction.y);
    bool negative = (along_x ? direction.x : direction.y) < 0.0;
    return (along_x ? 0u : 1u) + (negative ? 2u : 0u);
}

// Cluster of subdivision 2 [0, 8), of a unit direction. Even: near the pole; odd: tilted.
uint cluster_of(vec3 direction, uint clusters) {
    float split = clusters == CLUSTERS_PAPER ? LATITUDE_SPLIT_PAPER : LATITUDE_SPLIT;
    return 2u * sector_of(direction, clusters) + (direction.z < split ? 1u : 0u);
}

#endif
