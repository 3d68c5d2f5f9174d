#ifndef LOBE_LOBE_H
#define LOBE_LOBE_H

/// lobe: rendering whose appearance stays true at every distance. Includes all public headers
/// except lobe/vulkan.h. That one needs Vulkan's headers, which a host without Vulkan may not have,
/// and which others include in a way of their own (VK_NO_PROTOTYPES, volk) that must come first.

#include <lobe/allocator.h>
#include <lobe/animation.h>
#include <lobe/api.h>
#include <lobe/colour.h>
#include <lobe/deformation.h>
#include <lobe/device.h>
#include <lobe/environment.h>
#include <lobe/environment_maps.h>
#include <lobe/exr.h>
#include <lobe/file.h>
#include <lobe/filter.h>
#include <lobe/fitting.h>
#include <lobe/graph.h>
#include <lobe/host.h>
#include <lobe/image.h>
#include <lobe/maps.h>
#include <lobe/ocean.h>
#include <lobe/png.h>
#include <lobe/preparation.h>
#include <lobe/profile.h>
#include <lobe/renderer.h>
#include <lobe/result.h>
#include <lobe/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The version of the library, for example "0.1.0".
LOBE_API const char *lobe_version(void);

#ifdef __cplusplus
}
#endif

#endif
