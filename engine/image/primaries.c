#include <lobe/colour.h>

#include <math.h>
#include <string.h>

#include <cglm/cglm.h>

/// ITU-R BT.709, and D65: x and y of red, green, blue and white.
static const float rec709[4][2] = {
    {0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};

/// Twice the area of a triangle of primaries that span colours: that of Rec. 709 has 0.2.
#define LEAST_AREA 1e-5F

/// XYZ of a colour of luminance 1.
static void white_point(const float chromaticity[2], vec3 xyz) {
    xyz[0] = chromaticity[0] / chromaticity[1];
    xyz[1] = 1;
    xyz[2] = (1 - chromaticity[0] - chromaticity[1]) / chromaticity[1];
}

/// RGB to XYZ, such that (1, 1, 1) is white of luminance 1 (SMPTE RP 177-1993). Primaries need not
/// have a luminance. False if they span no colours.
static bool xyz_from_rgb(const float chromaticities[4][2], mat3 matrix) {
    vec3 white, parts;
    mat3 inverse;
    for (int i = 0; i < 3; i++) {
        const float *primary = chromaticities[i];
        glm_vec3_copy((vec3){primary[0], primary[1], 1 - primary[0] - primary[1]}, matrix[i]);
    }
    if (!(fabsf(glm_mat3_det(matrix)) > LEAST_AREA))
        return false;
    white_point(chromaticities[3], white);
    glm_mat3_inv(matrix, inverse);
    glm_mat3_mulv(inverse, white, parts);
    for (int i = 0; i < 3; i++)
        glm_vec3_scale(matrix[i], parts[i], matrix[i]);
    return true;
}

/// XYZ under one white to XYZ under another: von Kries in Bradford's cone responses, as ICC
/// profiles do (ISO 15076-1:2010, annex E).
static void adapt(const float from[2], const float to[2], mat3 matrix) {
    static const mat3 bradford = {
        {0.8951f, -0.7502f, 0.0389f}, {0.2664f, 1.7135f, -0.0685f}, {-0.1614f, 0.0367f, 1.0296f}};
    vec3 white, before, after;
    mat3 cones, scaled;
    memcpy(cones, bradford, sizeof cones);
    white_point(from, white);
    glm_mat3_mulv(cones, white, before);
    white_point(to, white);
    glm_mat3_mulv(cones, white, after);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            scaled[column][row] = cones[column][row] * after[row] / before[row];
    glm_mat3_inv(cones, matrix);
    glm_mat3_mul(matrix, scaled, matrix);
}

static bool all_finite(mat3 matrix) {
    for (int i = 0; i < 9; i++)
        if (!isfinite(matrix[i / 3][i % 3]))
            return false;
    return true;
}

static bool is_rec709(const float chromaticities[4][2]) {
    for (int i = 0; i < 8; i++)
        if (fabsf(chromaticities[i / 2][i % 2] - rec709[i / 2][i % 2]) > 1e-4f)
            return false;
    return true;
}

/// A channel without a finite value must not spread to the others.
static void convert(mat3 matrix, float texel[4]) {
    vec3 converted;
    if (!isfinite(texel[0]) || !isfinite(texel[1]) || !isfinite(texel[2]))
        return;
    const bool positive = texel[0] >= 0 && texel[1] >= 0 && texel[2] >= 0;
    glm_mat3_mulv(matrix, texel, converted);
    for (int i = 0; i < 3; i++)
        texel[i] = positive ? fmaxf(converted[i], 0) : converted[i];
}

bool lobe_image_to_rec709(lobe_image *image, const float chromaticities[4][2]) {
    if (!image || !image->texels || image->format != LOBE_FORMAT_RGBA32_FLOAT || !chromaticities)
        return false;
    mat3 matrix, adaptation, to_xyz;
    if (!xyz_from_rgb(chromaticities, to_xyz) || !xyz_from_rgb(rec709, matrix))
        return false;
    adapt(chromaticities[3], rec709[3], adaptation);
    glm_mat3_inv(matrix, matrix);
    glm_mat3_mul(matrix, adaptation, matrix);
    glm_mat3_mul(matrix, to_xyz, matrix);
    if (!all_finite(matrix))
        return false;
    float *texel = image->texels;
    const size_t count = is_rec709(chromaticities) ? 0 : (size_t)image->width * image->height;
    for (size_t i = 0; i < count; i++, texel += 4)
        convert(matrix, texel);
    return true;
}
