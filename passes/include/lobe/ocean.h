#ifndef LOBE_OCEAN_H
#define LOBE_OCEAN_H

#include <stdint.h>

#include <lobe/api.h>
#include <lobe/device.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/result.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The waves of a sea under steady wind, as periodic maps that passes make anew at each time.
///
/// Waves lie over a horizontal plane with the axes x and y, in metres; heights point upwards and
/// slopes are the height's derivatives (dh/dx, dh/dy). A spectrum S(k), k in rad/m, is that of
/// heights: its integral over k is their variance, in m2. What it says of directions is symmetric
/// about the wind's.

typedef enum lobe_ocean_spectrum {
    /// Elfouhaily, Chapron, Katsaros, Vandemark 1997, A Unified Directional Spectrum for Long and
    /// Short Wind-Driven Waves: down to capillary waves. Those are not damped by the peak's shape,
    /// as in the paper's Eq. 40 they would be.
    LOBE_OCEAN_ELFOUHAILY,
    /// Hasselmann et al. 1973, Measurements of Wind-Wave Growth and Swell Decay during the Joint
    /// North Sea Wave Project: a sea that grows with the fetch. Waves of 10 cm and more.
    LOBE_OCEAN_JONSWAP,
    /// Pierson, Moskowitz 1964, A Proposed Spectral Form for Fully Developed Wind Seas Based on the
    /// Similarity Theory of S. A. Kitaigorodskii: ignores the fetch. Waves of 10 cm and more.
    LOBE_OCEAN_PIERSON_MOSKOWITZ,
} lobe_ocean_spectrum;

/// How the waves of a length spread about the direction phi of the wind.
typedef enum lobe_ocean_spreading {
    /// Elfouhaily et al., Eq. 49: 1 + D(k) cos 2 phi.
    LOBE_OCEAN_SPREADING_SYMMETRIC,
    /// Hasselmann, Dunckel, Ewing 1980, Directional Wave Spectra Observed during JONSWAP 1973:
    /// cos(phi/2)^(2 s(k)), sharpest at the peak.
    LOBE_OCEAN_SPREADING_COSINE,
} lobe_ocean_spreading;

#define LOBE_OCEAN_MAXIMUM_LAYERS 3

/// All numbers count: start from lobe_ocean_default.
typedef struct lobe_ocean_parameters {
    lobe_ocean_spectrum spectrum;
    lobe_ocean_spreading spreading;
    float wind_speed;     ///< m/s, 10 m above the sea, [0, 60]; below 0.5: no waves
    float wind_direction; ///< radians, where it blows to: from +x towards +y
    float fetch;          ///< metres of open sea to windward, [1e3, 1e8]
    uint32_t size;        ///< texels along each side of a layer: a power of two, [8, 1024]
    uint32_t layers;      ///< [1, LOBE_OCEAN_MAXIMUM_LAYERS]
    /// Metres after which a layer repeats, [1, 1e5], each at most half of the one before. Waves
    /// are those of six to a length of the next layer, or longer, and shorter than those of the
    /// layer before.
    float lengths[LOBE_OCEAN_MAXIMUM_LAYERS];
    /// How far points move towards crests, in units of what linear waves do: sharpens these. [0, 2]
    float choppiness;
    uint32_t seed; ///< of phases and amplitudes: another sea under the same wind
} lobe_ocean_parameters;

/// Elfouhaily's sea under a wind of 10 m/s along +x after 1000 km, symmetric spreading: 256 texels
/// for each of 512, 61 and 7.3 m, choppiness 1.
LOBE_API void lobe_ocean_default(lobe_ocean_parameters *parameters);

/// Covariances of slopes, (xx, yy, xy), from the spectrum: the mean over all seas of such a wind.
/// They are those of linear waves; choppiness changes them by a few per cent.
typedef struct lobe_ocean_slopes {
    float total[3];
    /// Of the waves that each layer has, as they are interpolated between texels.
    float layers[LOBE_OCEAN_MAXIMUM_LAYERS][3];
    float rest[3]; ///< of all other waves: total less those of the layers
} lobe_ocean_slopes;

/// Takes about 0.1 s for three layers of 512 texels. Errors: LOBE_ERROR_INVALID_ARGUMENT, with one
/// line that names the number.
LOBE_API lobe_result lobe_ocean_measure(const lobe_ocean_parameters *parameters,
                                        const lobe_host *host, lobe_ocean_slopes *slopes);

/// A sea on a device.
typedef struct lobe_ocean lobe_ocean;

/// Draws the amplitudes of all waves. Takes about 0.3 s for three layers of 512 texels. The device
/// must live longer. On failure `*ocean` is NULL. Errors: LOBE_ERROR_INVALID_ARGUMENT (as
/// lobe_ocean_measure), LOBE_ERROR_OUT_OF_MEMORY, LOBE_ERROR_OUT_OF_DEVICE_MEMORY.
LOBE_API lobe_result lobe_ocean_create(lobe_device *device, const lobe_ocean_parameters *parameters,
                                       const lobe_host *host, lobe_ocean **ocean);
/// Clears the pointer; NULL is allowed.
LOBE_API void lobe_ocean_destroy(lobe_ocean **ocean);

/// Adds passes `spectrum` and `fft` that make the sea's maps at a time, and returns them: an image
/// with two layers of RGBA32_FLOAT for each layer of waves, of size x size texels. With x along
/// columns and y along rows, from texel (0, 0) on, the first layer of two has
///   h, D_x, D_y, dD_x/dy (= dD_y/dx)
/// and the second
///   dh/dx, dh/dy, dD_x/dx, dD_y/dy
/// where h is the height above the plane in metres, and the point at x moves across to x + D. A
/// surface that vertices show is that of the sum over all layers: (x + D, h); its slopes are the
/// heights' derivatives multiplied by the inverse transpose of I + dD/dx.
///
/// `seconds`: the time, [0, 65536); after that the waves repeat. In 2^-16 s, so that any two frames
/// of the same time are equal to the bit. Otherwise, and for NULL, the frame fails
/// (LOBE_ERROR_INVALID_ARGUMENT). The image is retained under a name that has the seed in it, so
/// that seas of one graph need different seeds: while frames ask for the same time, nothing runs.
LOBE_API lobe_resource lobe_ocean_add(const lobe_ocean *ocean, lobe_graph *graph, double seconds);

#ifdef __cplusplus
}
#endif

#endif
