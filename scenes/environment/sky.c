#include "scenes/environment/sky.h"

#include <math.h>
#include <stdlib.h>

#include "scenes/environment/daylight.h"
#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"

#define SUN_HEIGHT (40 * M_PI / 180)
#define SUN_TURN   (-30 * M_PI / 180)     // from +Z towards +X
#define SUN_RADIUS (0.26655 * M_PI / 180) // as seen from the earth at its mean distance
#define TURBIDITY  3.0
#define GROUND     0.2 // albedo

// Sample points along the disc's radius and around it; each represents the same area.
enum { DISC_POINTS = 96 };

static vector3 disc_point(vector3 direction, vector3 x, vector3 y, double radius, int ring,
                          int turn) {
    // 1 - cos(radius) without cancellation.
    const double height = 2 * sin(radius / 2) * sin(radius / 2) * (ring + 0.5) / DISC_POINTS;
    const double sine = sqrt(height * (2 - height)), angle = 2 * M_PI * (turn + 0.5) / DISC_POINTS;
    return vector3_add(
        vector3_scale(direction, 1 - height),
        vector3_add(vector3_scale(x, sine * cos(angle)), vector3_scale(y, sine * sin(angle))));
}

static size_t texel_of(const lobe_environment *environment, vector3 direction) {
    const lobe_image *image = &environment->image;
    const double to[3] = {direction.x, direction.y, direction.z};
    double position[2];
    scenes_environment_position(environment->layout, image->width, image->height, to, position);
    const double x = fmin(floor(position[0]), image->width - 1.0);
    const double y = fmin(floor(position[1]), image->height - 1.0);
    return (size_t)y * image->width + (size_t)x;
}

static int compare(const void *a, const void *b) {
    const size_t left = *(const size_t *)a, right = *(const size_t *)b;
    return (left > right) - (left < right);
}

static void add_light(lobe_environment *environment, size_t index, double part,
                      const double irradiance[3]) {
    const lobe_image *image = &environment->image;
    const double x = (double)(index % image->width), y = (double)(index / image->width);
    const double angle = scenes_environment_solid_angle(environment->layout, image->width,
                                                        image->height, x, y, x + 1, y + 1);
    float *texel = (float *)image->texels + 4 * index;
    for (int i = 0; i < 3; i++)
        texel[i] = (float)(texel[i] + part * irradiance[i] / angle);
}

// Points are counted before they are added: a sum of thousands of floats would drift.
void scenes_environment_add_disc(lobe_environment *environment, vector3 direction, double radius,
                                 const double irradiance[3]) {
    enum { COUNT = DISC_POINTS * DISC_POINTS };
    size_t texels[COUNT];
    const vector3 aside = fabs(direction.y) < 0.9 ? (vector3){0, 1, 0} : (vector3){1, 0, 0};
    vector3 x = vector3_cross(aside, direction);
    vector3_normalise(&x, 0);
    const vector3 y = vector3_cross(direction, x);
    for (int i = 0; i < COUNT; i++)
        texels[i] = texel_of(environment,
                             disc_point(direction, x, y, radius, i / DISC_POINTS, i % DISC_POINTS));
    qsort(texels, COUNT, sizeof *texels, compare);
    for (int first = 0, end; first < COUNT; first = end) {
        for (end = first + 1; end < COUNT && texels[end] == texels[first];)
            end++;
        add_light(environment, texels[first], (double)(end - first) / COUNT, irradiance);
    }
}

// ---------------------------------------------------------------------------------------------

typedef struct sky_scale {
    double factor;    // of all radiance
    double ground[3]; // radiance below the horizon, scaled
} sky_scale;

static sky_scale scale_of(const daylight *light) {
    double irradiance[3];
    scenes_daylight_ground_irradiance(light, irradiance);
    sky_scale scale = {.factor = M_PI / scenes_daylight_luminance(irradiance)};
    for (int i = 0; i < 3; i++)
        scale.ground[i] = scale.factor * GROUND * irradiance[i] / M_PI;
    return scale;
}

// Sample points of a texel along each axis, so that coarse images also hold means of the sky.
static int points_of(const lobe_image *image) {
    const uint32_t points = 128 / image->height;
    return points < 1 ? 1 : points > 8 ? 8 : (int)points;
}

static void add_point_of_sky(const daylight *light, const sky_scale *scale, const double d[3],
                             double sum[3]) {
    double sky[3];
    if (d[1] > 0)
        scenes_daylight_sky(light, (vector3){d[0], d[1], d[2]}, sky);
    for (int i = 0; i < 3; i++)
        sum[i] += d[1] > 0 ? scale->factor * sky[i] : scale->ground[i];
}

static void paint_texel(const lobe_image *image, const daylight *light, const sky_scale *scale,
                        uint32_t x, uint32_t y) {
    float *texel = (float *)image->texels + 4 * ((size_t)y * image->width + x);
    const int points = points_of(image);
    double sum[3] = {0};
    for (int i = 0; i < points * points; i++) {
        const double position[2] = {x + (i % points + 0.5) / points,
                                    y + (i / points + 0.5) / points};
        double d[3];
        scenes_environment_direction(LOBE_ENVIRONMENT_LATITUDE_LONGITUDE, image->width,
                                     image->height, position, d);
        add_point_of_sky(light, scale, d, sum);
    }
    for (int i = 0; i < 3; i++)
        texel[i] = (float)(sum[i] / (points * points));
    texel[3] = 1;
}

static void paint(lobe_environment *environment) {
    const vector3 sun = {sin(SUN_TURN) * cos(SUN_HEIGHT), sin(SUN_HEIGHT),
                         cos(SUN_TURN) * cos(SUN_HEIGHT)};
    const daylight light = scenes_daylight_of(sun, TURBIDITY);
    const sky_scale scale = scale_of(&light);
    const lobe_image *image = &environment->image;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++)
            paint_texel(image, &light, &scale, x, y);
    }
    double irradiance[3];
    for (int i = 0; i < 3; i++)
        irradiance[i] = scale.factor * light.sun_irradiance[i];
    scenes_environment_add_disc(environment, sun, SUN_RADIUS, irradiance);
}

lobe_result scenes_environment_sky(uint32_t width, uint32_t height, const lobe_host *host,
                                   lobe_environment **environment) {
    lobe_result result = scenes_environment_allocate("sky", host, environment);
    if (result == LOBE_OK)
        result = lobe_image_allocate(&(*environment)->image, LOBE_FORMAT_RGBA32_FLOAT, width,
                                     height, host);
    if (result == LOBE_OK)
        paint(*environment);
    else
        lobe_environment_destroy(environment);
    return result;
}
