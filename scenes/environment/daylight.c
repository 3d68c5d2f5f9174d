#include "scenes/environment/daylight.h"

#include <math.h>

enum { COEFFICIENTS = 5 };

// ---------------------------------------------------------------------------------------------
// Colour

// IEC 61966-2-1:1999, the primaries of Rec. 709. Colours outside their gamut are clipped.
static void rgb_of_yxy(const double colour[3], double rgb[3]) {
    static const double matrix[3][3] = {{3.240969942, -1.537383178, -0.498610760},
                                        {-0.969243636, 1.875967502, 0.041555057},
                                        {0.055630080, -0.203976959, 1.056971514}};
    const double luminance = colour[0], x = colour[1], y = colour[2];
    const double xyz[3] = {luminance * x / y, luminance, luminance * (1 - x - y) / y};
    for (int i = 0; i < 3; i++) {
        const double *row = matrix[i];
        rgb[i] = fmax(row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2], 0);
    }
}

double scenes_daylight_luminance(const double rgb[3]) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// ---------------------------------------------------------------------------------------------
// Sky

// Preetham et al. 1999, appendix A.2: coefficients A to E of luminance Y and chromaticities x, y
// are linear in the turbidity.
static void set_distribution(daylight *light, double turbidity) {
    static const double slopes[3][COEFFICIENTS] = {{0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
                                                   {-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
                                                   {-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}};
    static const double offsets[3][COEFFICIENTS] = {{-1.4630, 0.4275, 5.3251, -2.5771, 0.3703},
                                                    {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452},
                                                    {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < COEFFICIENTS; i++)
            light->distribution[k][i] = slopes[k][i] * turbidity + offsets[k][i];
    }
}

// The same appendix: chromaticity at the zenith, by powers of the turbidity (rows, from the square
// down) and of the sun's angle from the zenith (columns, from the cube down).
static double zenith_chromaticity(const double matrix[3][4], double turbidity, double angle) {
    double sum = 0;
    for (int row = 0; row < 3; row++) {
        const double *m = matrix[row];
        sum = sum * turbidity + (((m[0] * angle + m[1]) * angle + m[2]) * angle + m[3]);
    }
    return sum;
}

static void set_zenith(daylight *light, double turbidity, double angle) {
    static const double x[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                   {-0.02903, 0.06377, -0.03202, 0.00394},
                                   {0.11693, -0.21196, 0.06052, 0.25886}};
    static const double y[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                   {-0.04214, 0.08970, -0.04153, 0.00516},
                                   {0.15346, -0.26756, 0.06670, 0.26688}};
    const double chi = (4.0 / 9 - turbidity / 120) * (M_PI - 2 * angle);
    light->zenith[0] = (4.0453 * turbidity - 4.9710) * tan(chi) - 0.2155 * turbidity + 2.4192;
    light->zenith[1] = zenith_chromaticity(x, turbidity, angle);
    light->zenith[2] = zenith_chromaticity(y, turbidity, angle);
}

// Perez, Seals, Michalsky 1993, in Preetham et al. 1999, Eq. 3. `angle` is the angle to the sun.
static double perez(const double c[COEFFICIENTS], double cosine, double angle, double cosine_sun) {
    return (1 + c[0] * exp(c[1] / cosine)) *
           (1 + c[2] * exp(c[3] * angle) + c[4] * cosine_sun * cosine_sun);
}

// Eq. 4: the divisor for the zenith's values.
static void normalise(daylight *light, double angle) {
    for (int k = 0; k < 3; k++)
        light->zenith[k] /= perez(light->distribution[k], 1, angle, light->sun.y);
}

void scenes_daylight_sky(const daylight *light, vector3 direction, double rgb[3]) {
    const double cosine = fmax(direction.y, 1e-3);
    const double cosine_sun = fmin(fmax(vector3_dot(direction, light->sun), -1), 1);
    const double angle = acos(cosine_sun);
    double colour[3];
    for (int k = 0; k < 3; k++)
        colour[k] = light->zenith[k] * perez(light->distribution[k], cosine, angle, cosine_sun);
    rgb_of_yxy(colour, rgb);
}

// ---------------------------------------------------------------------------------------------
// Sun

// Preetham et al. 1999, appendix A.1, after Iqbal 1983: transmittance of air and haze. Ozone, mixed
// gases and water vapour absorb far less visible light and are left out.
static double transmittance(double micrometres, double mass, double turbidity) {
    const double haze = 0.04608 * turbidity - 0.04586;
    return exp(-mass * (0.008735 * pow(micrometres, -4.08) + haze * pow(micrometres, -1.3)));
}

// Outside the atmosphere: 128 klx (IES Lighting Handbook), the colour of a black body of 5778 K.
// Each channel is attenuated like light at the middle of its band.
static void set_sun(daylight *light, double turbidity) {
    static const double outside[3] = {128, 0.3263, 0.3357};
    static const double micrometres[3] = {0.61, 0.55, 0.465};
    const double degrees = acos(fmin(light->sun.y, 1)) * 180 / M_PI;
    const double mass = 1 / (light->sun.y + 0.15 * pow(93.885 - degrees, -1.253));
    rgb_of_yxy(outside, light->sun_irradiance);
    for (int i = 0; i < 3; i++)
        light->sun_irradiance[i] *= transmittance(micrometres[i], mass, turbidity);
}

daylight scenes_daylight_of(vector3 sun, double turbidity) {
    daylight light = {.sun = sun};
    const double angle = acos(fmin(sun.y, 1));
    set_distribution(&light, turbidity);
    set_zenith(&light, turbidity, angle);
    normalise(&light, angle);
    set_sun(&light, turbidity);
    return light;
}

void scenes_daylight_ground_irradiance(const daylight *light, double rgb[3]) {
    // The middles of bands of equal projected solid angle, which includes the cosine.
    enum { HEIGHTS = 64, TURNS = 128 };
    for (int i = 0; i < 3; i++)
        rgb[i] = light->sun_irradiance[i] * light->sun.y;
    for (int i = 0; i < HEIGHTS; i++) {
        const double sine = sqrt((i + 0.5) / HEIGHTS), cosine = sqrt(1 - sine * sine);
        for (int k = 0; k < TURNS; k++) {
            const double turn = 2 * M_PI * (k + 0.5) / TURNS;
            double sky[3];
            scenes_daylight_sky(light, (vector3){sine * sin(turn), cosine, sine * cos(turn)}, sky);
            for (int c = 0; c < 3; c++)
                rgb[c] += M_PI / (HEIGHTS * TURNS) * sky[c];
        }
    }
}
