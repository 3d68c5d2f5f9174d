#ifndef PASSES_MAPS_KEPT_SUBJECT_H
#define PASSES_MAPS_KEPT_SUBJECT_H

#include "passes/context/filter.h"
#include "passes/maps/kept/kept_file.h"

/// A file of a map, and the work that it takes.
typedef struct kept_tile {
    kept_layout layout;
    uint32_t parts; ///< of the work, one tile after the other
} kept_tile;

/// How a material's maps are made with the settings of this frame.
typedef struct kept_subject {
    uint64_t kind;   ///< digest of the settings
    uint64_t inputs; ///< digest of what they are made from, within this process
    bool has_texels; ///< the host has all that they are made from
    uint32_t tile_count;
    /// What each tile's file has, from 0 on. Buffers are alike in all of them.
    kept_tile (*tile)(const filter_context *context, uint32_t material, const void *user,
                      uint32_t tile);
    uint64_t map_bytes;     ///< of device memory
    uint64_t making_bytes;  ///< of what makes tiles that are not loaded; the same
    bool makes_files_alone; ///< nothing reads the maps: what the folder has of them is not loaded
    /// What the file of a share has, where what a map is made from can be shared: slices of
    /// buffers, of which those of all shares are joined one behind the other, but the last buffer,
    /// which all have alike. No buffers: an empty share. NULL: shares consist of tiles, if there
    /// are any.
    kept_layout (*share)(const filter_context *context, uint32_t material, const void *user,
                         uint32_t share);
    /// A digest of all that they are made from, texels included, for a file's name. Called once,
    /// where the host has the texels.
    uint64_t (*key)(const filter_context *context, uint32_t material, const void *user);
    const void *user;
} kept_subject;

#endif
