#include "tests/passes/support/environment_reference.h"

#include <math.h>

#include "tests/reference/light/cube_texel.h"

// ---------------------------------------------------------------------------------------------
// Environments

lobe_environment environment_of_colour(lobe_environment_layout layout, uint32_t width,
                                       uint32_t height, const float colour[3]) {
    lobe_environment environment = {.name = "test", .layout = layout, .intensity = 1};
    assert_int_equal(
        lobe_image_allocate(&environment.image, LOBE_FORMAT_RGBA32_FLOAT, width, height, NULL),
        LOBE_OK);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (int i = 0; i < 3; i++)
                environment_texel(&environment, x, y)[i] = colour[i];
    return environment;
}

float *environment_texel(const lobe_environment *environment, uint32_t x, uint32_t y) {
    return (float *)environment->image.texels + 4 * ((size_t)y * environment->image.width + x);
}

lobe_environment environment_of_patches(uint32_t width, uint32_t height) {
    lobe_environment environment = environment_of_colour(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, width,
                                                         height, (float[3]){0, 0, 0});
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            double longitude = 2 * M_PI * (x + 0.5) / width, sine = sin(M_PI * (y + 0.5) / height);
            float *texel = environment_texel(&environment, x, y);
            texel[0] = (float)(1 + sine * cos(longitude));
            texel[1] = (float)(1 + sine * sin(3 * longitude));
            texel[2] = (float)y / (float)height;
            if (x > width / 3 && x < width / 2 && y > height / 3 && y < height / 2)
                texel[2] += 20;
        }
    return environment;
}

lobe_environment_maps *make_maps(fixture *f, const lobe_environment *environment, uint32_t size,
                                 bool lobes, bool ggx) {
    lobe_environment_maps *maps;
    lobe_environment_maps_parameters parameters = {
        .environment = environment,
        .size = size,
        .wanted = {[LOBE_ENVIRONMENT_VON_MISES_FISHER] = lobes, [LOBE_ENVIRONMENT_GGX] = ggx},
        .host = &f->host,
    };
    if (lobe_environment_maps_create(f->device, &parameters, &maps) != LOBE_OK)
        fail_msg("no maps: %s", f->error);
    return maps;
}

// ---------------------------------------------------------------------------------------------
// Cubes

host_cube read_cube(lobe_environment_maps *maps, lobe_environment_map map) {
    const lobe_environment_maps_information *information = lobe_environment_maps_describe(maps);
    host_cube cube = {information->width[map], information->levels[map], {{{0}}}};
    for (uint32_t level = 0; level < cube.levels; level++)
        for (uint32_t face = 0; face < 6; face++)
            assert_int_equal(
                lobe_environment_maps_read(maps, map, level, face, &cube.faces[level][face]),
                LOBE_OK);
    return cube;
}

void free_cube(host_cube *cube) {
    for (uint32_t level = 0; level < cube->levels; level++)
        for (uint32_t face = 0; face < 6; face++)
            lobe_image_free(&cube->faces[level][face]);
}

const float *cube_texel(const host_cube *cube, uint32_t level, int face, int x, int y) {
    int width = (int)(cube->width >> level);
    return (const float *)cube->faces[level][face].texels + 4 * ((size_t)y * (size_t)width + x);
}

void cube_energy(const host_cube *cube, uint32_t level, double energy[3]) {
    int width = (int)(cube->width >> level);
    energy[0] = energy[1] = energy[2] = 0;
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < width; y++)
            for (int x = 0; x < width; x++)
                for (int i = 0; i < 3; i++)
                    energy[i] += reference_cube_texel_solid_angle(x, y, width) *
                                 cube_texel(cube, level, face, x, y)[i];
}

/// The point of a face, each coordinate in [-1, 1] or beyond, as a direction.
static void face_direction(int face, double x, double y, double direction[3]) {
    const double directions[6][3] = {{1, -y, -x}, {-1, -y, x}, {x, 1, y},
                                     {x, -1, -y}, {x, -y, 1},  {-x, -y, -1}};
    for (int i = 0; i < 3; i++)
        direction[i] = directions[face][i];
}

static int clamp(int value, int width) {
    return value < 0 ? 0 : value >= width ? width - 1 : value;
}

/// A texel at most one beyond one edge of its face: then the neighbour's next to that edge. NULL
/// beyond a corner.
static const float *texel_across(const host_cube *cube, uint32_t level, int face, int x, int y) {
    int width = (int)(cube->width >> level);
    bool beyond_x = x < 0 || x >= width, beyond_y = y < 0 || y >= width;
    if (!beyond_x && !beyond_y)
        return cube_texel(cube, level, face, x, y);
    if (beyond_x && beyond_y)
        return NULL;
    double point[2] = {(2 * x + 1.0 - width) / width, (2 * y + 1.0 - width) / width};
    if (beyond_x)
        point[0] = x < 0 ? -1 - 1e-9 : 1 + 1e-9;
    else
        point[1] = y < 0 ? -1 - 1e-9 : 1 + 1e-9;
    double direction[3], position[2];
    face_direction(face, point[0], point[1], direction);
    int neighbour = reference_cube_face(direction, position);
    return cube_texel(cube, level, neighbour, clamp((int)(position[0] * width), width),
                      clamp((int)(position[1] * width), width));
}

void cube_fetch(const host_cube *cube, uint32_t level, const double direction[3], double value[3]) {
    double position[2], sum[3] = {0}, missing = 0;
    int face = reference_cube_face(direction, position), width = (int)(cube->width >> level);
    double x = position[0] * width - 0.5, y = position[1] * width - 0.5;
    value[0] = value[1] = value[2] = 0;
    for (int corner = 0; corner < 4; corner++) {
        int column = (int)floor(x) + corner % 2, row = (int)floor(y) + corner / 2;
        double weight = (1 - fabs(x - column)) * (1 - fabs(y - row));
        const float *texel = texel_across(cube, level, face, column, row);
        for (int i = 0; texel && i < 3; i++) {
            value[i] += weight * texel[i];
            sum[i] += texel[i];
        }
        missing += texel ? 0 : weight;
    }
    for (int i = 0; i < 3; i++)
        value[i] += missing * sum[i] / 3;
}

// ---------------------------------------------------------------------------------------------
// Lobes

double reference_vmf_lobe(double x, double concentration) {
    return concentration == 0
               ? 1 / (4 * M_PI)
               : concentration / (-2 * M_PI * expm1(-2 * concentration)) * exp(-concentration * x);
}

double reference_ggx_lobe(double x, double concentration) {
    double alpha_squared = concentration > 0.5 ? 1 / (2 * concentration) : 1;
    // sin^2(theta/2) = x/2; the norm over the sphere of D(theta/2) is 4.
    double root = alpha_squared * (1 - x / 2) + x / 2;
    return alpha_squared / (M_PI * root * root) / 4;
}

void exact_light(const host_cube *radiance, const double direction[3], reference_lobe lobe,
                 double concentration, double value[3]) {
    int width = (int)radiance->width;
    value[0] = value[1] = value[2] = 0;
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < width; y++)
            for (int x = 0; x < width; x++) {
                double centre[3], square = 0;
                reference_cube_texel_direction(face, x, y, width, centre);
                for (int i = 0; i < 3; i++)
                    square += (centre[i] - direction[i]) * (centre[i] - direction[i]);
                double weight =
                    reference_cube_texel_solid_angle(x, y, width) * lobe(square / 2, concentration);
                for (int i = 0; i < 3; i++)
                    value[i] += weight * cube_texel(radiance, 0, face, x, y)[i];
            }
}
