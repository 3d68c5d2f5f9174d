#ifndef INTERFACE_REFLECTED_LOBES_H
#define INTERFACE_REFLECTED_LOBES_H

// What microfacets reflect of white light towards a viewer, as a density of incoming directions
// that is a sum of round lobes, each as one fetch from an environment filtered with von
// Mises-Fisher lobes sees it: a blend of those of two levels. The first are about directions in the
// plane of reflection; each of the others is a pair, one on either side of it, half of its weight
// each.
#define REFLECTED_LOBES_IN_PLANE 6
#define REFLECTED_LOBES          8

// The table: columns are the square root of the cosine to the viewer, from 0 in the first texel's
// centre to 1 in the last one's; rows are roughness, from the least to the greatest. Layer i holds
// of lobe i: the angle from the mirror direction in the plane of reflection, away from the normal,
// radians; how far it lies beside that plane (the component of its unit axis), [0, 1]; the level to
// read, as the binary logarithm of the texels along its faces, 0 or more, which says the same for
// cubes of all sizes; its weight. All weights add up to 1.
#define REFLECTED_LOBES_SIZE               16
#define REFLECTED_LOBES_LEAST_ROUGHNESS    0.1f
#define REFLECTED_LOBES_GREATEST_ROUGHNESS 0.7f
// Smoother surfaces reflect a single lobe; from here on, what is said here.
#define REFLECTED_LOBES_FULL_ROUGHNESS 0.15f

#endif
