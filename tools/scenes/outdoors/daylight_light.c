#include "tools/scenes/outdoors/daylight_light.h"

#include <math.h>

#include "scenes/environment/daylight.h"
#include "scenes/environment/direction.h"
#include "scenes/environment/environment.h"
#include "scenes/scene/scene.h"

static lobe_result add_sun(lobe_scene *scene, vector3 towards, const double irradiance[3],
                           const lobe_host *host) {
    lobe_light light = {.type = LOBE_LIGHT_DIRECTIONAL};
    vector3_store(vector3_scale(towards, -1 / vector3_length(towards)), light.direction);
    for (int i = 0; i < 3; i++)
        light.intensity[i] = (float)irradiance[i];
    return scenes_add_light(scene, &light, host);
}

/// The sky without the sun's disc. `ground`: radiance below the horizon; NULL: as the horizon's.
static void paint(lobe_environment *sky, const daylight *light, double factor,
                  const double *ground) {
    float *texel = sky->image.texels;
    for (uint32_t y = 0; y < sky->image.height; y++)
        for (uint32_t x = 0; x < sky->image.width; x++, texel += 4) {
            const double position[2] = {x + 0.5, y + 0.5};
            double direction[3], rgb[3];
            scenes_environment_direction(sky->layout, sky->image.width, sky->image.height, position,
                                         direction);
            scenes_daylight_sky(light, (vector3){direction[0], direction[1], direction[2]}, rgb);
            for (int i = 0; i < 3; i++)
                texel[i] =
                    (float)fmax(factor * (ground && direction[1] < 0 ? ground[i] : rgb[i]), 0);
            texel[3] = 1;
        }
}

lobe_result daylight_light_add(lobe_scene *scene, const daylight_light *light,
                               const lobe_host *host) {
    vector3 direction = light->sun;
    vector3_normalise(&direction, 0);
    const daylight day = scenes_daylight_of(direction, light->turbidity);
    double level[3], ground[3], irradiance[3];
    scenes_daylight_ground_irradiance(&day, level);
    const double factor = M_PI / scenes_daylight_luminance(level);
    for (int i = 0; i < 3; i++)
        ground[i] = light->ground * level[i] / M_PI;
    lobe_environment *sky;
    lobe_result result = scenes_environment_allocate(light->name, host, &sky);
    if (result == LOBE_OK)
        result = lobe_image_allocate(&sky->image, LOBE_FORMAT_RGBA32_FLOAT, 512, 256, host);
    if (result != LOBE_OK) {
        lobe_environment_destroy(&sky);
        return result;
    }
    paint(sky, &day, factor, light->ground < 0 ? NULL : ground);
    lobe_scene_set_environment(scene, sky);
    scene->environment_visible = true;
    for (int i = 0; i < 3; i++)
        irradiance[i] = factor * day.sun_irradiance[i];
    return add_sun(scene, light->sun, irradiance, host);
}
