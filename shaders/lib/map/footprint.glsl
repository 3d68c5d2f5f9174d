#ifndef LIB_FOOTPRINT_GLSL
#define LIB_FOOTPRINT_GLSL

// The image of a pixel in a map: an ellipse given by its half axes' lengths and the direction of
// the longer one.
struct footprint {
    float major_axis; // texels
    float minor_axis; // texels
    vec2 direction;   // unit, of the major axis
};

// Heckbert 1989, Fundamentals of Texture Mapping and Image Warping, section 3.5: the unit square
// of a pixel is stretched by the Jacobian J = [dx dy]; the axes are the singular values of J, the
// square roots of the eigenvalues of J J^T. `dx` and `dy` are in texels per pixel.
footprint footprint_of(vec2 dx, vec2 dy) {
    float xx = dx.x * dx.x + dy.x * dy.x;
    float xy = dx.x * dx.y + dy.x * dy.y;
    float yy = dx.y * dx.y + dy.y * dy.y;
    float mean = 0.5 * (xx + yy);
    float difference = 0.5 * (xx - yy);
    float radius = sqrt(difference * difference + xy * xy);
    footprint result;
    result.major_axis = sqrt(mean + radius);
    // The product of the axes is |det J|; mean - radius would cancel for long, thin footprints.
    result.minor_axis = abs(dx.x * dy.y - dx.y * dy.x) / max(result.major_axis, 1e-30);
    // An eigenvector, from the row that does not cancel.
    vec2 eigenvector = difference > 0.0 ? vec2(difference + radius, xy)
                                        : vec2(xy, radius - difference);
    float size = length(eigenvector);
    result.direction = size > 0.0 ? eigenvector / size : vec2(1.0, 0.0);
    return result;
}

// The MIP level (0: a map's own texels; unbounded below) whose texels are as large as what one of
// `probes` probes along the major axis has to cover.
float level_of(footprint area, float probes) {
    return log2(max(max(area.major_axis / probes, area.minor_axis), 1e-6));
}

#endif
