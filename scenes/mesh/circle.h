#ifndef SCENES_MESH_CIRCLE_H
#define SCENES_MESH_CIRCLE_H

/// The point of the unit circle after `turns` turns counter-clockwise from (1, 0): the cosine and
/// sine of 2 pi turns, within 4e-16. It uses only additions and multiplications, so that every
/// machine gets the same bits; cos and sin of the C library do not guarantee that.
void scenes_circle_point(double turns, double point[2]);

#endif
