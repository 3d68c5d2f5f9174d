#ifndef PASSES_CONTEXT_SHARED_KNOBS_H
#define PASSES_CONTEXT_SHARED_KNOBS_H

#include "passes/context/knob.h"

/// Knobs of every filter, listed after its own; NULL-terminated.
extern const filter_knob *const passes_shared_knobs[];

extern const filter_knob passes_knob_view, passes_knob_samples, passes_knob_base;
/// Whether surfaces are shaded after all of them have been drawn (passes/renderer/surfaces/).
extern const filter_knob passes_knob_shading;
/// Whether height maps displace geometry, and how finely.
extern const filter_knob passes_knob_displacement, passes_knob_pixels_per_vertex;
/// Whether lights have shadow maps, and of how many texels.
extern const filter_knob passes_knob_shadows;
/// Knobs of environment light.
extern const filter_knob passes_knob_environment, passes_knob_environment_size,
    passes_knob_environment_probes, passes_knob_environment_levels, passes_knob_environment_grid,
    passes_knob_environment_window, passes_knob_horizon, passes_knob_scattering;

/// Replaces passes_knob_environment in filters that supersample. Its default is exact: each of
/// their samples takes one sample of the environment.
extern const filter_knob passes_knob_reference_environment;

/// Of filters whose surfaces can be closed.
extern const filter_knob passes_knob_normal_mapping;

#endif
