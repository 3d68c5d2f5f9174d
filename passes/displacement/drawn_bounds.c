#include "passes/displacement/drawn_bounds.h"

void passes_drawn_bounds(const device_scene *scene, float minimum[3], float maximum[3]) {
    for (int i = 0; i < 3; i++) {
        minimum[i] = scene->scene->minimum[i] - scene->displaced_reach;
        maximum[i] = scene->scene->maximum[i] + scene->displaced_reach;
    }
}
