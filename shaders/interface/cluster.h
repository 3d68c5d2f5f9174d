#ifndef INTERFACE_CLUSTER_H
#define INTERFACE_CLUSTER_H

// How directions are divided: our own way, or that of Xu et al. 2017, section 4.
#define CLUSTERS_TURNED 0 // sectors about the axes; split close to the pole
#define CLUSTERS_PAPER  1 // quadrants; split in the middle of the latitudes

// Cosine of the tilt at which a sector is split, 12 degrees. Half the hemisphere would be 60
// degrees, but the normals of real maps stay near the pole. Measured as mean L1 error of the
// mixture over seven photographed and drawn normal maps, noise, bumps, the tablecloth and
// camera-space patches, with kappa of 30 to 600: 19 % from 9 to 12 degrees, 21 % at 18, 26 % at 52;
// 33 % with sectors alone. Only strongly tilted patches in camera space do better with 50 degrees
// (21 % instead of 35 %).
#define LATITUDE_SPLIT 0.978
// 45 degrees. The paper divides latitude into two components, and does not say where.
#define LATITUDE_SPLIT_PAPER 0.70710678

#endif
