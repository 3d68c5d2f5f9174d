#ifndef INTERFACE_OCEAN_H
#define INTERFACE_OCEAN_H

#include "specialisation.h"
#include "types.h"

// Fields of a layer of waves, four real numbers each, with x and y along columns and rows:
//   [0]  h, D_x, D_y, dD_x/dy (which is dD_y/dx)
//   [1]  dh/dx, dh/dy, dD_x/dx, dD_y/dy
// h: height; D: how far the point at x moves across, to x + D; choppiness included. Metres.
#define OCEAN_FIELD_PLACE     0
#define OCEAN_FIELD_GRADIENTS 1
#define OCEAN_FIELDS          2

#define OCEAN_MAXIMUM_LAYERS 3

// Units of time, to the second: frequencies are whole numbers of turns in 2^16 s, so that a phase
// is the product of two whole numbers modulo 2^32, and the waves repeat after 2^16 s.
#define OCEAN_TICKS 65536

// Push constants of spectrum.comp.
struct ocean_spectrum_constants {
    float4 step; // of wave numbers, rad/m: 2 pi over each layer's length; w: choppiness
    uint size;   // texels along each side
    uint time;   // in ticks
    uint padding_0;
    uint padding_1;
};
INTERFACE_SIZE(ocean_spectrum_constants, 32)
INTERFACE_OFFSET(ocean_spectrum_constants, size, 16)
INTERFACE_OFFSET(ocean_spectrum_constants, time, 20)

// Push constants of fft_step.comp and fft_line.comp.
struct ocean_fft_constants {
    uint size;    // numbers in a line, a power of two
    uint done;    // size of the transforms that earlier steps have made; fft_line.comp: 1
    uint columns; // 0: rows are transformed; 1: columns
};
INTERFACE_SIZE(ocean_fft_constants, 12)
INTERFACE_OFFSET(ocean_fft_constants, done, 4)
INTERFACE_OFFSET(ocean_fft_constants, columns, 8)

// uint: 2, 4 or 8; of fft_line.comp: of its last step, or 1 for none
#define SPECIALISE_RADIX (SPECIALISE_FILTER + 60)
// uint: numbers in a line, of fft_line.comp
#define SPECIALISE_LINE (SPECIALISE_FILTER + 61)

#endif
