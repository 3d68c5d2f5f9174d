#ifndef TESTS_REFERENCE_LIGHT_CUBE_TEXEL_H
#define TESTS_REFERENCE_LIGHT_CUBE_TEXEL_H

/// Texels of a cube map in double precision; see shaders/lib/light/cube_texel.glsl. Faces in the
/// order +X -X +Y -Y +Z -Z, of size x size texels, rows from top to bottom.

/// Face that a direction falls on, and where, each coordinate in [0, 1]: as samplers look it up.
int reference_cube_face(const double direction[3], double position[2]);

/// Unit direction of the centre of texel (x, y).
void reference_cube_texel_direction(int face, int x, int y, int size, double direction[3]);

/// Steradians of a texel.
double reference_cube_texel_solid_angle(int x, int y, int size);

#endif
