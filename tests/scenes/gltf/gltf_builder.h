#ifndef TESTS_GLTF_BUILDER_H
#define TESTS_GLTF_BUILDER_H

#include "tests/scenes/gltf/gltf_fixture.h"

/// A GLB file, accessor by accessor.
typedef struct gltf_builder {
    char views[8192], accessors[8192];
    uint8_t binary[32768];
    size_t size;
    unsigned count; ///< of accessors
} gltf_builder;

/// Adds an accessor of its own buffer view; returns its index. `type`: "VEC3".
unsigned gltf_builder_add(gltf_builder *builder, gltf_component component, const char *type,
                          bool normalised, size_t count, const void *data, size_t size);

/// The same for floats: one for each of `count` times the channels of the type.
unsigned gltf_builder_add_floats(gltf_builder *builder, const char *type, size_t count,
                                 const float *values);

/// Writes the file. `members`: of the root, each preceded by a comma.
void gltf_builder_write(const gltf_builder *builder, const gltf_fixture *fixture, const char *name,
                        const char *members);

#endif
