#ifndef LIB_REFLECTION_LOBE_GLSL
#define LIB_REFLECTION_LOBE_GLSL

#include "lib/number/constants.glsl"

// Where the light comes from that a microfacet surface reflects towards a viewer: its reflectance
// times cosine as a density of incoming directions, in a form that filtered environments can look
// up. It is no Gaussian about the mirror direction: the mask and the horizon cut it off on the far
// side, and for alpha near 1 nothing of a mirror is left.
//
// With the albedo's parts F_0 x + F_90 y (lib/microfacet/directional_albedo.glsl) it is
// approximated by
//   F_0 x ((1 - d) lobe + d <n, i>/pi) + F_90 y lobe_90,
// lobes in the plane of reflection and a share d of light as a Lambert surface gathers it.
//
// The lobe's numbers are polynomials in roughness and 1 - cos of the viewer, whose 64 coefficients
// minimise the squared error of F_0's part over 0 <= roughness <= 1 and views up to 84 degrees: its
// error on the sphere, more of its first spherical harmonics, and of its mean over all normals at
// an angle to the viewer, with the lobe as a row of round ones (environment/environment.glsl): GGX
// where it is narrow, von Mises-Fisher where it is broad. No environment went into them.

struct reflection_lobe {
    float angle; // of the axis from the normal, away from the viewer, radians
    // Standard deviations of directions, radians, along the plane of reflection and across it.
    float along, across;
    float diffuse_share; // d, [0, 1]
};

vec4 cubic(vec4 a, vec4 b, vec4 c, vec4 d, float x) {
    return ((d * x + c) * x + b) * x + a;
}

// By powers of u = 1 - cosine (outer) and of roughness:
//   x: (angle/theta - 1)/alpha, theta the mirror's angle
//   y: log(along/(sqrt(2) alpha)): 0 for a narrow lobe, seen along the normal
//   z: q, with across/along = sqrt(cos^2 + q^2 sin^2): the plain mirror has cos
//   w: d/roughness^3
vec4 reflection_lobe_of_ggx(float u, float roughness) {
    return cubic(
        cubic(vec4(0.295, -0.049, 0.056, -0.703), vec4(-2.496, 0.854, -0.966, 12.454),
              vec4(7.542, -2.68, 4.022, -17.933), vec4(-5.742, 1.364, -2.196, 6.998), roughness),
        cubic(vec4(-1.846, -1.114, 2.667, 0.071), vec4(7.565, 8.483, -4.188, -7.374),
              vec4(-18.218, -17.428, 4.429, 4.122), vec4(9.418, 8.872, -2.167, 2.973), roughness),
        cubic(vec4(3.017, 1.787, -1.044, -0.563), vec4(5.191, -18.542, -3.883, 13.222),
              vec4(-32.483, 29.65, 2.72, -7.256), vec4(32.007, -9.022, 0.521, -4.335), roughness),
        cubic(vec4(-0.188, -2.483, -1.759, -0.204), vec4(-28.532, 20.275, 5.814, 10.685),
              vec4(79.614, -32.857, 1.935, -31.511), vec4(-56.875, 13.171, -5.438, 20.013),
              roughness),
        u);
}

// For Beckmann's distribution, and those about as broad.
vec4 reflection_lobe_of_beckmann(float u, float roughness) {
    return cubic(
        cubic(vec4(-0.125, -0.06, 0.049, -0.089), vec4(1.419, 0.775, -0.243, 1.704),
              vec4(-0.504, -2.313, 0.062, 1.092), vec4(-1.859, 1.355, 0.568, -2.006), roughness),
        cubic(vec4(0.451, -0.068, 0.921, -0.934), vec4(-4.308, 1.311, 0.593, -2.168),
              vec4(-0.847, -3.094, 0.279, -2.812), vec4(4.629, 0.589, 0.389, 6.149), roughness),
        cubic(vec4(0.91, -0.212, -0.54, 2.168), vec4(-2.682, 0.394, -0.084, 1.88),
              vec4(1.404, 1.139, -0.776, -5.698), vec4(2.156, -1.255, -0.868, 0.09), roughness),
        cubic(vec4(-1.162, -0.68, -0.723, -1.179), vec4(1.513, -2.482, 1.465, 3.571),
              vec4(4.221, 6.276, 0.163, -4.602), vec4(-6.024, -2.531, -0.621, 2.939), roughness),
        u);
}

// What F_0 reflects. `tails` [0, 1]: 1 of GGX, 0 of Beckmann's distribution or one without long
// tails.
reflection_lobe lobe_of_reflection(float tails, float outgoing_cosine, float roughness) {
    float cosine = clamp(outgoing_cosine, 0.0, 1.0);
    float alpha = max(roughness * roughness, ALPHA_MINIMUM);
    vec4 p = tails >= 1.0   ? reflection_lobe_of_ggx(1.0 - cosine, roughness)
             : tails <= 0.0 ? reflection_lobe_of_beckmann(1.0 - cosine, roughness)
                            : mix(reflection_lobe_of_beckmann(1.0 - cosine, roughness),
                                  reflection_lobe_of_ggx(1.0 - cosine, roughness), tails);
    float q = clamp(p.z, 0.0, 1.0);
    reflection_lobe result;
    result.angle = acos(cosine) * (1.0 + alpha * p.x);
    result.along = sqrt(2.0) * alpha * exp(p.y);
    result.across = result.along * sqrt(mix(cosine * cosine, 1.0, q * q));
    result.diffuse_share = clamp(roughness * roughness * roughness * p.w, 0.0, 1.0);
    return result;
}

// What F_90 reflects: (1 - <i, h>)^5 leaves directions near the horizon, at about 70 degrees for
// any rough surface and any viewer.
reflection_lobe lobe_of_grazing_reflection(float outgoing_cosine, float roughness) {
    float cosine = clamp(outgoing_cosine, 0.0, 1.0);
    float alpha = max(roughness * roughness, ALPHA_MINIMUM);
    float rough = min(alpha / 0.36, 1.0);
    reflection_lobe result;
    result.angle = mix(acos(cosine), 1.22, rough);
    result.along = sqrt(2.0) * alpha / (1.0 + 5.0 * alpha);
    result.across = result.along * mix(cosine, 1.0, rough);
    result.diffuse_share = 0.0;
    return result;
}

// Both as one lobe, of their mean and variance. `share`: of the second.
reflection_lobe mixed_lobe(reflection_lobe first, reflection_lobe second, float share) {
    float apart = second.angle - first.angle;
    reflection_lobe result = first;
    result.angle += share * apart;
    result.along = sqrt(mix(first.along * first.along, second.along * second.along, share) +
                        share * (1.0 - share) * apart * apart);
    result.across = mix(first.across, second.across, share);
    return result;
}

// Of a lobe that a polynomial over the hemisphere completes (environment/broad_reflection.comp):
// what it has to show is narrower, and nearer to the horizon. `completed`: how much of it [0, 1].
reflection_lobe completed_lobe(reflection_lobe lobe, float outgoing_cosine, float completed) {
    float cosine = clamp(outgoing_cosine, 0.0, 1.0);
    reflection_lobe result = lobe;
    result.angle = min(lobe.angle + 0.16 * completed * sqrt(1.0 - cosine * cosine), 1.5);
    result.along *= 1.0 - 0.3 * completed;
    result.across *= 1.0 - 0.3 * completed;
    return result;
}

#endif
