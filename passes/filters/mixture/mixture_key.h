#ifndef PASSES_FILTERS_MIXTURE_MIXTURE_KEY_H
#define PASSES_FILTERS_MIXTURE_MIXTURE_KEY_H

#include "passes/filters/mixture/mixture_map.h"

/// Increment it whenever the same material is fitted or stored differently: old files are then no
/// longer found.
#define MIXTURE_FILE_VERSION 8

/// A digest of the settings of a fit.
uint64_t passes_mixture_kind_digest(const filter_context *context, const mixture_kind *kind);

/// A digest of what a material's mixture was made from, which holds within this process: it does
/// not look at texels.
uint64_t passes_mixture_inputs(const filter_context *context, const device_material *material,
                               bool own_colours);

/// Whether the host has all texels that the mixture is made from. Those that it gives on the device
/// may be others in every frame.
bool passes_mixture_has_texels(const filter_context *context, const device_material *material,
                               bool own_colours);

/// A digest of all that a material's mixture is made from, texels included, for a file's name. The
/// host must have the texels.
uint64_t passes_mixture_key(const filter_context *context, const device_material *material,
                            const mixture_kind *kind);

#endif
