#ifndef TESTS_REFERENCE_LOBE_LAMBERT_PLANE_H
#define TESTS_REFERENCE_LOBE_LAMBERT_PLANE_H

/// Lambert's azimuthal projection in double precision; see shaders/lib/lobe/lambert_plane.glsl.

/// Of a unit direction other than (0, 0, -1): |place| = 2 sin(theta / 2).
void reference_plane_from_direction(const double direction[3], double place[2]);
/// Of a place within the disc of radius 2.
void reference_direction_from_plane(const double place[2], double direction[3]);

/// J J^T (xx, yy, xy) of the projection at a place, J from differences of the projection itself.
void reference_plane_distortion(const double place[2], double distortion[3]);

#endif
