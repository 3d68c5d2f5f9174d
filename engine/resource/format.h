#ifndef ENGINE_RESOURCE_FORMAT_H
#define ENGINE_RESOURCE_FORMAT_H

#include <vulkan/vulkan.h>

#include <lobe/image.h>

/// VK_FORMAT_UNDEFINED for LOBE_FORMAT_NONE.
VkFormat engine_format_vulkan(lobe_format format);

/// Depth for LOBE_FORMAT_D32_FLOAT, else colour.
VkImageAspectFlags engine_format_aspect(lobe_format format);

#endif
