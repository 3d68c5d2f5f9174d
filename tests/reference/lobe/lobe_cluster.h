#ifndef TESTS_REFERENCE_LOBE_LOBE_CLUSTER_H
#define TESTS_REFERENCE_LOBE_LOBE_CLUSTER_H

#include <stdbool.h>
#include <stdint.h>

/// The cluster [0, 8) of a unit direction: twice its sector (+x, +y, -x, -y, 90 degrees each about
/// the axis), plus one where it is tilted from the pole by more than about 12 degrees. `paper`: the
/// sectors begin at +x, +y, -x, -y, and the tilt is 45 degrees. A direction within rounding of a
/// border may go either way on a device. See shaders/lib/lobe/lobe_cluster.glsl.
uint32_t reference_cluster_of(const double direction[3], bool paper);

#endif
