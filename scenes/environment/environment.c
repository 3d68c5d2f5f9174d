#include "scenes/environment/environment.h"

#include <math.h>
#include <string.h>

#include "scenes/environment/direction.h"
#include "scenes/environment/halve.h"
#include "scenes/environment/repair.h"

// The resolution of the largest cube that is made of an environment, 2048 texels per face.
#define LARGEST_FACE  2048
#define LARGEST_WIDTH (4 * LARGEST_FACE)

lobe_result scenes_environment_allocate(const char *name, const lobe_host *host,
                                        lobe_environment **environment) {
    *environment = lobe_allocate(lobe_host_allocator(host), 1, sizeof **environment);
    if (*environment)
        (*environment)->name = lobe_copy_text(lobe_host_allocator(host), name);
    if (!*environment || !(*environment)->name) {
        lobe_environment_destroy(environment);
        return lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "%s: out of memory", name);
    }
    (*environment)->intensity = 1;
    for (int i = 0; i < 3; i++)
        (*environment)->world_from_environment[i][i] = 1;
    return LOBE_OK;
}

static bool is_finer_than_needed(const lobe_environment *environment) {
    uint32_t grid[2];
    scenes_environment_grid(environment->layout, grid);
    const bool faces = environment->layout != LOBE_ENVIRONMENT_LATITUDE_LONGITUDE;
    const lobe_image *image = &environment->image;
    return image->width / grid[0] > (faces ? LARGEST_FACE : LARGEST_WIDTH) ||
           image->height / grid[1] > (faces ? LARGEST_FACE : LARGEST_WIDTH);
}

static bool is_larger_than(const lobe_environment *environment, uint32_t extent) {
    return environment->image.width > extent || environment->image.height > extent;
}

void lobe_environment_shrink(lobe_environment *environment, uint32_t maximum_extent) {
    if (!environment)
        return;
    while (is_larger_than(environment, maximum_extent) &&
           scenes_environment_can_be_halved(environment))
        scenes_environment_halve(environment);
}

lobe_result scenes_environment_complete(lobe_environment *environment, const lobe_host *host) {
    const uint32_t width = environment->image.width, height = environment->image.height;
    lobe_result result = scenes_environment_repair(environment, host);
    if (result != LOBE_OK)
        return result;
    while (is_finer_than_needed(environment))
        scenes_environment_halve(environment);
    lobe_environment_shrink(environment, LOBE_ENVIRONMENT_MAXIMUM_EXTENT);
    if (environment->image.width != width || environment->image.height != height)
        lobe_host_log(host, LOBE_LOG_NOTICE,
                      "%s: %u x %u texels are finer than lobe needs; halved to %u x %u",
                      environment->name, width, height, environment->image.width,
                      environment->image.height);
    return LOBE_OK;
}

void lobe_environment_turn(lobe_environment *environment, double degrees) {
    if (!environment)
        return;
    const double angle = degrees * M_PI / 180, cosine = cos(angle), sine = sin(angle);
    for (int column = 0; column < 3; column++) {
        float *v = environment->world_from_environment[column];
        const double x = v[0], z = v[2];
        v[0] = (float)(cosine * x + sine * z);
        v[2] = (float)(cosine * z - sine * x);
    }
}

bool lobe_environment_position(const lobe_environment *environment, const double direction[3],
                               double position[2]) {
    if (!environment || !direction || !position)
        return false;
    const lobe_image *image = &environment->image;
    if (!scenes_environment_layout_fits(environment->layout, image->width, image->height))
        return false;
    scenes_environment_position(environment->layout, image->width, image->height, direction,
                                position);
    return true;
}

void lobe_environment_destroy(lobe_environment **environment) {
    if (!environment || !*environment)
        return;
    lobe_image_free(&(*environment)->image);
    lobe_release((*environment)->name);
    lobe_release(*environment);
    *environment = NULL;
}
