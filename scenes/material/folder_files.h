#ifndef SCENES_MATERIAL_FOLDER_FILES_H
#define SCENES_MATERIAL_FOLDER_FILES_H

#include <stdint.h>

#include <lobe/host.h>
#include <lobe/result.h>

#include "scenes/material/file_name.h"

/// An image file of a folder, and what its name says.
typedef struct material_file {
    char *name;
    bool readable; ///< PNG, JPEG or OpenEXR
    material_file_content content;
} material_file;

/// Where a map comes from: a file, and its channel if only one holds the map.
typedef struct material_source {
    const material_file *file; ///< NULL: the folder has no such map
    uint32_t channel;          ///< [0, 3]
} material_source;

typedef struct material_files {
    material_file *files; ///< in alphabetical order
    size_t count;
    /// The word after the resolution that names of several maps end with, and that names none;
    /// static. NULL: there is none.
    const char *workflow;
    /// Of two maps that serve the same purpose (normals, roughness), only one has a source.
    material_source sources[MATERIAL_MAP_COUNT];
} material_files;

/// Finds the maps among the files of a folder, and says in notices which file became which map and
/// which images were ignored. Of several files for one map the first in alphabetical order is used;
/// packed files with the channels of glTF come before files of one map, other packed files after
/// them. Errors: LOBE_ERROR_NOT_FOUND (no folder, no map besides that of heights), _READ,
/// _UNSUPPORTED (maps of several materials), _OUT_OF_MEMORY. To free in any case.
lobe_result scenes_material_files_find(const char *folder, const lobe_host *host,
                                       material_files *files);
void scenes_material_files_free(material_files *files);

#endif
