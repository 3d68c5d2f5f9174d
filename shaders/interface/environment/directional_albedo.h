#ifndef INTERFACE_DIRECTIONAL_ALBEDO_H
#define INTERFACE_DIRECTIONAL_ALBEDO_H

#include "../types.h"

// The table of directional albedo: columns are the square root of the cosine to the viewer, rows
// are roughness, each from 0 in the first texel's centre to 1 in the last one's. What its channels
// hold is in shaders/environment/directional_albedo.comp.
//
// The error of linear interpolation between texels is at most 2e-3 (2e-4 root mean square) for
// cosines above 0.02 and roughness above 0.05; with 32 x 32 texels it would be 6.4e-3. With columns
// uniform in the cosine itself it would be 7.9e-3: reflection changes most near the horizon.
#define DIRECTIONAL_ALBEDO_SIZE 64

#endif
