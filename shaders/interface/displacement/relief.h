#ifndef INTERFACE_RELIEF_H
#define INTERFACE_RELIEF_H

#include "../specialisation.h"
#include "../types.h"

// The relief of a material with a height map: a surface of two triangles for each square between
// the centres of four neighbouring texels, repeated without end. Lengths are in widths of a texel.
// Its frame: x along u, y along v (opposite to y of the tangent frame), z outwards; texel (i, j) is
// the vertex at (i, j). The height of the carrier is the mean of all texels'.
//
// Level 0 is the map itself, maxima_block holds the others: a value of level l is the largest
// height of a square of 4^l by 4^l quads, cut off at the map's ends.
#define HEIGHT_LEVELS 8
struct height_level {
    uint offset; // of its first value; of level 0, such that level 1 follows it: negative
    uint width;  // values
    uint height;
    uint padding;
};
INTERFACE_SIZE(height_level, 16)
INTERFACE_OFFSET(height_level, width, 4)
INTERFACE_OFFSET(height_level, height, 8)
#ifndef VULKAN
typedef struct height_level height_level;
#endif

struct height_field_constants {
    uint width; // texels
    uint height;
    uint last_level;                    // of one value
    float scale;                        // of the map's values, widths of a texel
    height_level levels[HEIGHT_LEVELS]; // level 0: the texels
    float least_value;                  // of the map: values beyond these count as the ends
    float largest_value;
    uint padding_x;
    uint padding_y;
};
INTERFACE_SIZE(height_field_constants, 160)
INTERFACE_OFFSET(height_field_constants, height, 4)
INTERFACE_OFFSET(height_field_constants, last_level, 8)
INTERFACE_OFFSET(height_field_constants, scale, 12)
INTERFACE_OFFSET(height_field_constants, levels, 16)
INTERFACE_OFFSET(height_field_constants, least_value, 144)
INTERFACE_OFFSET(height_field_constants, largest_value, 148)

// Heights beyond this, in widths of a texel, are cut off.
#define HEIGHT_MAXIMUM 65536.0

// ---------------------------------------------------------------------------------------------
// What the filter `displaced` keeps of a relief. b are the coefficients, in functions of direction,
// of the cosine of a facet's normal where its centre sees the sky; o are those of the light that
// other facets send it, if all reflect everything and the sky shines as each function. With a, the
// area of a facet over that of its projection, and means over the facets of a cell:
//
// entries of a texel, four to a layer:
// [0, n (n + 1) / 2)   C = mean a b b^T / pi, lower triangle, row by row; n: order
// then 10              N = mean a (b o^T + o b^T) / (2 pi), of the first four polynomials: light
//                      between facets depends on directions smoothly
// then                 mean of what the facets reflect of light that has met one other facet
// then n               mean a b: the area that is seen from each direction, over that of the cell
//
// Where the diffuse colour varies over the relief, so do these, for red, green and blue, each from
// a layer of its own on; the seen area is red's. C = mean s a b b^T / pi with the diffuse colour s
// below what the facet mirrors at right angles, N has a factor r, all that a facet reflects, and o
// is of light that is multiplied by r at each facet. What has met one other facet is the mean of s
// instead.
//
// Where facets shine, emission comes after all channels, for red, green and blue:
// n                    mean a m b: the light that is sent in each direction. m is what a facet
//                      emits, e, and what it reflects of others', evenly: m = e + r mean m over
//                      its links
// then 1               mean a (m - e) b, integrated over all directions over pi
#define TRANSFER_MAXIMUM_ORDER  9
#define TRANSFER_BASIS_TERMS    16 // polynomials that a function is a sum of
#define TRANSFER_INDIRECT       4
#define TRANSFER_INDIRECT_COUNT 10
#define TRANSFER_LINKS          4
#define TRANSFER_COLOUR_WORDS   3 // of a facet's s and r, two to a word
// Words of a facet's b, which ends with the coefficients in the second to fourth polynomial;
// entries of a channel, and layers of the first and of each further one.
#define TRANSFER_WORDS(order)          (((order) + TRANSFER_INDIRECT) / 2u)
#define TRANSFER_DIRECT_COUNT(order)   ((order) * ((order) + 1u) / 2u)
#define TRANSFER_ENTRIES(order)        (TRANSFER_DIRECT_COUNT(order) + TRANSFER_INDIRECT_COUNT + 1u)
#define TRANSFER_FIRST_LAYERS(order)   ((TRANSFER_ENTRIES(order) + (order) + 3u) / 4u)
#define TRANSFER_FURTHER_LAYERS(order) ((TRANSFER_ENTRIES(order) + 3u) / 4u)
// Of all channels, one unless colours vary: before those of emission.
#define TRANSFER_CHANNEL_LAYERS(order, coloured)                                                   \
    (TRANSFER_FIRST_LAYERS(order) + ((coloured) ? 2u * TRANSFER_FURTHER_LAYERS(order) : 0u))
#define TRANSFER_MAXIMUM_LAYERS 45u // of the largest order, where colours vary
// Entries of emission of a channel, and layers of all three.
#define TRANSFER_EMISSION(order)        ((order) + 1u)
#define TRANSFER_EMISSION_LAYERS(order) ((3u * TRANSFER_EMISSION(order) + 3u) / 4u)

// The functions, made for each map by transfer_basis: sums of the polynomials of
// lib/displacement/transfer_basis.glsl, orthonormal. The first is the first polynomial; the others
// are those in which the light that cells of the map reflect at once differs the most. Cells of so
// many quads' side, in each of which so many quads are looked at, up to so many along a side.
#define TRANSFER_BASIS_CELL    16
#define TRANSFER_BASIS_POINTS  8
#define TRANSFER_BASIS_MAXIMUM 12
//
// Bins of facets' normals, made for each map by facet_groups: a mixture of Gaussians of their
// places in the Lambert plane of the tangent frame.
#define FACET_BINS       5
#define FACET_DIRECTIONS 48
#define SECOND_FACTORS   9
struct transfer_basis_constants {
    float4 functions[4 * TRANSFER_MAXIMUM_ORDER]; // 16 factors each
    float4 integrals[3];                          // over the hemisphere; the last is 0, but for x
    // Of each bin, its mean, the logarithm of its part of the facets' area over the root of its
    // covariance's determinant, and that part; then its inverse covariance, (xx, yy, xy), and the
    // covariance's determinant.
    float4 groups[2 * FACET_BINS];
    // What the relief hides of the cosine, from each of facet_direction(), times the cosine to the
    // carrier and the direction's part of the hemisphere.
    float4 hidden[FACET_DIRECTIONS / 4];
    float4 second[SECOND_FACTORS * FACET_BINS]; // see lib/displacement/second_facets.glsl
};
INTERFACE_SIZE(transfer_basis_constants, 1696)
INTERFACE_OFFSET(transfer_basis_constants, integrals, 576)
INTERFACE_OFFSET(transfer_basis_constants, groups, 624)
INTERFACE_OFFSET(transfer_basis_constants, hidden, 784)
INTERFACE_OFFSET(transfer_basis_constants, second, 976)
#ifndef VULKAN
typedef struct transfer_basis_constants transfer_basis_constants;
#endif

// Of the whole map, written by transfer_closure.
struct transfer_closure_constants {
    transfer_basis_constants basis;
    // What the mean of C and N lacks, so that a white relief reflects all light.
    float4 lacking[4]; // in all polynomials
    float4 visible[4]; // mean a b, in all polynomials
    float lost;        // the integral of what lacks
    float persistence; // [0, 1): the part of light between facets that meets another one
    float direct;      // the part of diffuse light that a white relief reflects at once
    float padding;
    float4 emission[TRANSFER_MAXIMUM_ORDER]; // mean a m b, of all channels
    float4 mean[TRANSFER_MAXIMUM_LAYERS];    // of all layers
};
INTERFACE_SIZE(transfer_closure_constants, 2704)
INTERFACE_OFFSET(transfer_closure_constants, lacking, 1696)
INTERFACE_OFFSET(transfer_closure_constants, visible, 1760)
INTERFACE_OFFSET(transfer_closure_constants, lost, 1824)
INTERFACE_OFFSET(transfer_closure_constants, persistence, 1828)
INTERFACE_OFFSET(transfer_closure_constants, direct, 1832)
INTERFACE_OFFSET(transfer_closure_constants, emission, 1840)
INTERFACE_OFFSET(transfer_closure_constants, mean, 1984)

// The map of facets' normals: of each bin, two layers of means over a cell: p a and p a d_x, p a
// d_y, p a h; then p a d_x^2, p a d_y^2, p a d_x d_y, p a e, with d the place less the bin's mean,
// and p the part that the bin has of a facet (lib/displacement/facet_bins.glsl). With the cosines
// of a direction to the facet and to the carrier, h is the integral of their product over what the
// relief hides from the facet, and e what it would be if the relief hid as much of it as of others.
//
// Where roughness varies over the relief, a layer more of each bin, after all others: means of g p
// a, g p a d_x, g p a d_y, g p a h, with g the facet's mean square of the map's roughness: alpha,
// but for the material's factor.

// Push constants of the passes between.
//
// Buffers of facets hold those of a *window* of the relief, by number within it: of all quads, or,
// where these are too many, of a tile and what is around it. A facet beyond the window is taken for
// the one that lies whole windows away within it.
struct transfer_constants {
    uint width; // quads of the window
    uint height;
    uint azimuths;
    uint first;        // facet_bounces, facet_emission: 1 in the first step
    uint channel;      // of colour, where that varies
    uint first_thread; // of a band of facet_transfer or facet_links
    uint first_facet;  // of the buffer that these write
    uint origin_x;     // of the window, in the relief: quads
    uint origin_y;
    uint first_column; // of the cells that cell_transfer makes of a window: texels of the map
    uint first_row;
    uint target_column; // of the image that they go to: the same, 0 if it is all of the map
    uint target_row;
};
INTERFACE_SIZE(transfer_constants, 52)
INTERFACE_OFFSET(transfer_constants, height, 4)
INTERFACE_OFFSET(transfer_constants, azimuths, 8)
INTERFACE_OFFSET(transfer_constants, first, 12)
INTERFACE_OFFSET(transfer_constants, channel, 16)
INTERFACE_OFFSET(transfer_constants, first_thread, 20)
INTERFACE_OFFSET(transfer_constants, first_facet, 24)
INTERFACE_OFFSET(transfer_constants, origin_x, 28)
INTERFACE_OFFSET(transfer_constants, origin_y, 32)
INTERFACE_OFFSET(transfer_constants, first_column, 36)
INTERFACE_OFFSET(transfer_constants, first_row, 40)
INTERFACE_OFFSET(transfer_constants, target_column, 44)
INTERFACE_OFFSET(transfer_constants, target_row, 48)

// Push constants of facet_colours.
struct colour_constants {
    float4 base_colour; // factor of the map
    uint width;         // quads of the window
    uint height;
    uint points;    // at which colours are read in each facet, along a side
    float metallic; // factor of the map
    uint origin_x;  // of the window
    uint origin_y;
    uint relief_width; // quads
    uint relief_height;
};
INTERFACE_SIZE(colour_constants, 48)
INTERFACE_OFFSET(colour_constants, width, 16)
INTERFACE_OFFSET(colour_constants, height, 20)
INTERFACE_OFFSET(colour_constants, points, 24)
INTERFACE_OFFSET(colour_constants, metallic, 28)
INTERFACE_OFFSET(colour_constants, origin_x, 32)
INTERFACE_OFFSET(colour_constants, origin_y, 36)
INTERFACE_OFFSET(colour_constants, relief_width, 40)
INTERFACE_OFFSET(colour_constants, relief_height, 44)

// uint, 4 to 9: how many functions C has
#define SPECIALISE_TRANSFER_ORDER (SPECIALISE_FILTER + 32)
// bool: the diffuse colour varies over the relief
#define SPECIALISE_TRANSFER_COLOURED (SPECIALISE_FILTER + 33)
// bool: pixels may see less than two of the height map's texels
#define SPECIALISE_TRANSFER_MAGNIFIED (SPECIALISE_FILTER + 34)
// bool: microfacets' roughness varies over the relief
#define SPECIALISE_TRANSFER_WIDTHS (SPECIALISE_FILTER + 39)
// bool: the relief's facets shine
#define SPECIALISE_TRANSFER_EMISSION (SPECIALISE_FILTER + 42)

// bool: the material has a relief
#define SPECIALISE_RELIEF (SPECIALISE_FILTER + 30)
// uint, of `displaced-reference`: vertices of a path, at most
#define SPECIALISE_PATH_VERTICES (SPECIALISE_FILTER + 31)

#endif
