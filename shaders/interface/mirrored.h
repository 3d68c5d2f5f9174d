#ifndef INTERFACE_MIRRORED_H
#define INTERFACE_MIRRORED_H

// What microfacets that are not metal mirror of light along their normal: glTF 2.0, appendix B.2.
#define DIELECTRIC_F0 0.04

// So much a texel counts in averages that are weighted by F0, in any case: lobes have a width where
// all is black, which still mirrors at grazing angles. More in bins, whose sums have 16 bits.
#define LEAST_MIRRORED      0.005
#define LEAST_MIRRORED_BINS 0.02

#endif
