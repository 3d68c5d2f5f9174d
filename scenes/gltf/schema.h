#ifndef SCENES_GLTF_SCHEMA_H
#define SCENES_GLTF_SCHEMA_H

#include <stdbool.h>
#include <stddef.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "scenes/gltf/pointer/pointer_nodes.h"

/// Whether lobe supports the extension of that name.
bool scenes_gltf_extension_supported(const char *name);

/// Checks the JSON text of a glTF file as far as lobe reads it, before a parser builds anything:
/// first its version and the extensions it requires, then the type of every value. Errors:
/// LOBE_ERROR_MALFORMED; LOBE_ERROR_UNSUPPORTED (the version, or a required extension);
/// LOBE_ERROR_OUT_OF_MEMORY. `pointers` receives the targets of animations that lack a node.
lobe_result scenes_gltf_schema_check(const char *path, const char *json, size_t size,
                                     const lobe_host *host, pointer_nodes *pointers);

#endif
