#ifndef PASSES_MAPS_KEPT_SUBJECT_H
#define PASSES_MAPS_KEPT_SUBJECT_H

#include "passes/context/filter.h"
#include "passes/maps/kept/kept_file.h"

/// How a material's maps are made with the settings of this frame.
typedef struct kept_subject {
    uint64_t kind;   ///< digest of the settings
    uint64_t inputs; ///< digest of what they are made from, within this process
    uint32_t parts;  ///< of the work
    bool has_texels; ///< the host has all that they are made from
    kept_layout layout;
    /// What the file of a share has, where the work can be shared: slices of buffers, of which
    /// those of all shares are joined one behind the other, but the last buffer, which all have
    /// alike. No buffers: an empty share. NULL: the work cannot be shared.
    kept_layout (*share)(const filter_context *context, uint32_t material, const void *user,
                         uint32_t share);
    /// A digest of all that they are made from, texels included, for a file's name. Called once,
    /// where the host has the texels.
    uint64_t (*key)(const filter_context *context, uint32_t material, const void *user);
    const void *user;
} kept_subject;

#endif
