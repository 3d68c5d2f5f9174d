#ifndef TESTS_REFERENCE_MICROFACET_FACING_NORMALS_H
#define TESTS_REFERENCE_MICROFACET_FACING_NORMALS_H

/// Gaussians of normals that face the viewer and the light, as in
/// shaders/lib/microfacet/facing_normals.glsl.

/// Normals by the mean and covariance (xx, yy, xy) of their places in the Lambert plane.
typedef struct reference_normals {
    double mean[3], place[2], covariance[3];
} reference_normals;

/// From sums over the normals of their places and of the second moments (xx, yy, xy), and the sum
/// of the weights.
reference_normals reference_normals_of(const double places[2], const double seconds[3],
                                       double weight);

/// Leaves those that face a direction; returns their share.
double reference_face(reference_normals *normals, const double direction[3]);

/// Mean of max(<n, direction>, 0).
double reference_mean_facing_cosine(const reference_normals *normals, const double direction[3]);

#endif
