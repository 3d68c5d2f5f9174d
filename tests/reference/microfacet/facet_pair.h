#ifndef TESTS_REFERENCE_FACET_PAIR_H
#define TESTS_REFERENCE_FACET_PAIR_H

/// A mapped facet and the upright one that closes the surface, in double precision; see
/// shaders/lib/microfacet/facet_pair.glsl. Directions of unit length, from above the surface.

enum { MAPPED_FACET, UPRIGHT_FACET };

/// Normals of both facets; `slope` is not 0.
void reference_facet_normals(const double slope[2], double normals[2][3]);

/// lambda_p and lambda_t.
void reference_facet_shares(const double slope[2], const double direction[3], double shares[2]);

/// G1 of a direction, 0 from below the surface.
double reference_facet_masking(const double slope[2], const double direction[3]);

/// What a Lambert facet p sends to t.
double reference_facet_exchange(const double slope[2]);

/// K, for facets of this albedo, of which p reflects `returned` to t.
double reference_facet_gain(const double slope[2], double albedo, double returned);

/// What both facets reflect if both are Lambert's, times the incoming cosine.
double reference_lambert_facet_pair(const double slope[2], double albedo, const double outgoing[3],
                                    const double incoming[3]);

#endif
