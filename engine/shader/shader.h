#ifndef ENGINE_SHADER_H
#define ENGINE_SHADER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#include <lobe/device.h>

/// A variable that descriptors are bound to. All are in set 0.
typedef struct engine_shader_binding {
    const char *name; ///< of the variable; for blocks, of the block
    uint32_t binding;
    uint32_t count; ///< array elements; 1 if it is not an array
    /// UNIFORM_BUFFER, STORAGE_BUFFER, COMBINED_IMAGE_SAMPLER, SAMPLED_IMAGE or STORAGE_IMAGE.
    VkDescriptorType type;
    VkShaderStageFlags stages;
    VkImageViewType view; ///< images: 2D, 2D_ARRAY, CUBE, CUBE_ARRAY or 3D
    bool multisampled;    ///< images
    lobe_format format;   ///< storage images; NONE if the shader does not say or lobe has
                          ///< no such format
    bool reads, writes;   ///< as `readonly` and `writeonly` allow; samplers only read
    bool used;            ///< the entry point refers to it: a descriptor is needed
    size_t size;          ///< blocks: bytes, without a trailing runtime array
} engine_shader_binding;

typedef struct engine_shader {
    const char *name; ///< "reduction.comp"
    VkShaderStageFlagBits stage;
    const uint32_t *words; ///< SPIR-V, which outlives this
    size_t word_count;
    uint64_t version; ///< stamp (see engine_device_stamp) of the code; changes on reload
    engine_shader_binding *bindings; ///< ordered by binding
    size_t binding_count;
    uint32_t push_constant_size; ///< bytes; 0: none
    uint32_t local_size[3];      ///< compute
    uint32_t local_size_ids[3];  ///< compute: constant_id that sets the extent; UINT32_MAX: none
    uint32_t *specialisation_ids;
    size_t specialisation_count;
    uint32_t output_locations; ///< fragment: bit n is set where location n is written
} engine_shader;

/// A shader as the build embeds it: its SPIR-V, and the sources it was compiled from, so that a
/// build with hot reload can recompile it.
typedef struct engine_shader_code {
    const char *name; ///< "shading/shading_lobes_aov.frag"
    /// "shading/shading.frag", relative to the shader folder; NULL: there is only SPIR-V.
    const char *source;
    const char *definitions; ///< "AOV", separated by spaces
    const char *substitute;  ///< replaces `#include "filter.glsl"`; "" if nothing
    const uint32_t *words;
    size_t size; ///< bytes
} engine_shader_code;

/// The shaders embedded in the library, from shaders/; ordered by name.
extern const engine_shader_code engine_embedded_shaders[];
extern const size_t engine_embedded_shaders_count;

#endif
