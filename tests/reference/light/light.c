#include "tests/reference/light/light.h"

#include <math.h>

double reference_distance_attenuation(double distance, double range) {
    double window = range > 0 ? fmax(1 - pow(distance / range, 4), 0) : 1;
    return distance < 1e-15 ? 0 : window / (distance * distance);
}

double reference_cone_attenuation(double cosine, double inner_cone, double outer_cone) {
    double width = fmax(0.001, cos(inner_cone) - cos(outer_cone));
    double fade = (cosine - cos(outer_cone)) / width;
    fade = fmin(fmax(fade, 0), 1);
    return fade * fade;
}
