#include <lobe/environment.h>

#include <stdlib.h>

#include "scenes/environment_direction.h"

bool lobe_environment_position(const lobe_environment *environment, const double direction[3],
                               double position[2]) {
    const lobe_image *image = &environment->image;
    if (!environment_layout_fits(environment->layout, image->width, image->height))
        return false;
    environment_position(environment->layout, image->width, image->height, direction, position);
    return true;
}

void lobe_environment_destroy(lobe_environment **environment) {
    if (!environment || !*environment)
        return;
    lobe_image_free(&(*environment)->image);
    free((*environment)->name);
    free(*environment);
    *environment = NULL;
}
