#include <lobe/environment.h>

#include <stdbool.h>
#include <string.h>

#include <lobe/exr.h>
#include <lobe/file.h>

#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"
#include "scenes/environment/sky.h"
#include "scenes/format/exr_file.h"
#include "scenes/format/host_file.h"
#include "scenes/format/radiance_hdr.h"

// ---------------------------------------------------------------------------------------------
// Layouts

static bool find_cube(const lobe_image *image, lobe_environment_layout *layout) {
    static const lobe_environment_layout cubes[] = {
        LOBE_ENVIRONMENT_CUBE_COLUMN, LOBE_ENVIRONMENT_CUBE_ROW, LOBE_ENVIRONMENT_VERTICAL_CROSS,
        LOBE_ENVIRONMENT_HORIZONTAL_CROSS};
    for (size_t i = 0; i < sizeof cubes / sizeof *cubes; i++) {
        if (scenes_environment_layout_fits(cubes[i], image->width, image->height)) {
            *layout = cubes[i];
            return true;
        }
    }
    return false;
}

// Images that are not 2:1 may have been stretched, or have an odd size.
static bool may_be_latitude_longitude(const lobe_image *image) {
    return image->width >= image->height && image->width / 4 <= image->height;
}

static bool is_twice_as_wide(const lobe_image *image) {
    const uint64_t width = image->width, height = image->height;
    return width + 1 >= 2 * height && width <= 2 * height + 1;
}

static lobe_result choose_layout(lobe_environment *environment, lobe_exr_environment said,
                                 const lobe_host *host) {
    const lobe_image *image = &environment->image;
    environment->layout = LOBE_ENVIRONMENT_LATITUDE_LONGITUDE;
    if (said == LOBE_EXR_LATITUDE_LONGITUDE || find_cube(image, &environment->layout))
        return LOBE_OK;
    if (said == LOBE_EXR_CUBE || !may_be_latitude_longitude(image))
        return lobe_host_fail(
            host, LOBE_ERROR_UNSUPPORTED,
            "%s: %u x %u texels are not an environment of a known shape: latitude and "
            "longitude (2:1), columns and rows of six faces (1:6, 6:1), crosses "
            "(3:4, 4:3)",
            environment->name, image->width, image->height);
    if (!is_twice_as_wide(image))
        lobe_host_log(host, LOBE_LOG_NOTICE,
                      "%s: taken as latitude and longitude, though %u x %u texels are not 2:1",
                      environment->name, image->width, image->height);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Files

static lobe_result decode(const char *name, const uint8_t *bytes, size_t size,
                          const lobe_host *host, lobe_image *image, lobe_exr_environment *said) {
    *said = LOBE_EXR_NO_ENVIRONMENT;
    if (scenes_exr_recognise(bytes, size))
        return scenes_exr_decode(bytes, size, name, host, image, said);
    if (scenes_radiance_hdr_recognise(bytes, size))
        return scenes_radiance_hdr_decode(bytes, size, name, host, image);
    return lobe_host_fail(host, size < 4 ? LOBE_ERROR_MALFORMED : LOBE_ERROR_UNSUPPORTED,
                          "%s: neither an OpenEXR file nor a Radiance picture", name);
}

static lobe_result read_image(const lobe_environment_open_parameters *parameters,
                              const lobe_host *host, lobe_image *image,
                              lobe_exr_environment *said) {
    const char *name = parameters->environment;
    uint8_t *bytes;
    size_t size;
    if (parameters->data)
        return decode(name, parameters->data, parameters->size, host, image, said);
    lobe_result result = scenes_host_file_read(parameters->files, name, NULL, host, &bytes, &size);
    if (result == LOBE_OK)
        result = decode(name, bytes, size, host, image, said);
    lobe_release(bytes);
    return result;
}

static lobe_result open_file(const lobe_environment_open_parameters *parameters,
                             const lobe_host *host, lobe_environment **environment) {
    lobe_exr_environment said;
    lobe_result result = scenes_environment_allocate(parameters->environment, host, environment);
    if (result == LOBE_OK)
        result = read_image(parameters, host, &(*environment)->image, &said);
    if (result == LOBE_OK)
        result = choose_layout(*environment, said, host);
    if (result == LOBE_OK)
        result = scenes_environment_complete(*environment, host);
    if (result != LOBE_OK)
        lobe_environment_destroy(environment);
    return result;
}

lobe_result lobe_environment_open_with(const lobe_environment_open_parameters *parameters,
                                       const lobe_host *host, lobe_environment **environment) {
    if (environment)
        *environment = NULL;
    if (!parameters || !parameters->environment || !environment)
        return lobe_host_fail(host, LOBE_ERROR_INVALID_ARGUMENT,
                              "lobe_environment_open_with: parameters, their environment (a name) "
                              "and environment must not be NULL");
    if (!parameters->data && strcmp(parameters->environment, "sky") == 0)
        return scenes_environment_sky(ENVIRONMENT_SKY_WIDTH, ENVIRONMENT_SKY_HEIGHT, host,
                                      environment);
    return open_file(parameters, host, environment);
}

lobe_result lobe_environment_open(const char *file_or_sky, const lobe_host *host,
                                  lobe_environment **environment) {
    return lobe_environment_open_with(
        &(lobe_environment_open_parameters){.environment = file_or_sky}, host, environment);
}
