#ifndef TOOLS_COMPARE_FLIP_COLOUR_H
#define TOOLS_COMPARE_FLIP_COLOUR_H

/// Colour spaces of the metric FLIP. Linear RGB has the primaries of Rec. 709 and the white point
/// D65, values [0, 1].

/// YCxCz (Flohr et al. 1993): opponent colours that are linear in RGB, so that they may be
/// filtered. Y [-16, 100]: achromatic; Cx: red-green; Cz: blue-yellow.
void flip_colour_to_opponent(const float rgb[3], float opponent[3]);
void flip_colour_from_opponent(const float opponent[3], float rgb[3]);

/// CIE L*a*b* with a* and b* scaled by 0.01 L* (Hunt effect: dark colours look less colourful).
void flip_colour_to_hunt_lab(const float rgb[3], float lab[3]);

/// HyAB distance (Abasi et al. 2020): city-block in lightness, Euclidean in the chroma plane.
float flip_colour_distance(const float lab1[3], const float lab2[3]);

#endif
