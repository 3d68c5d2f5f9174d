#include <lobe/environment.h>

#include <stdlib.h>

void lobe_environment_destroy(lobe_environment **environment) {
    if (!environment || !*environment)
        return;
    lobe_image_free(&(*environment)->image);
    free((*environment)->name);
    free(*environment);
    *environment = NULL;
}
