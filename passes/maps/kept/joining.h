#ifndef PASSES_MAPS_KEPT_JOINING_H
#define PASSES_MAPS_KEPT_JOINING_H

#include "passes/maps/kept/restoring.h"
#include "passes/maps/kept/subject.h"

/// Loads the files of all shares of a map's work, as many as the frame says, and joins what they
/// have: see kept_subject.share. One that is missing or does not belong to the others fails the
/// frame, with a line that names it; `joined` is then empty. Errors: LOBE_ERROR_OUT_OF_MEMORY, ...
lobe_result passes_kept_join(const filter_context *context, uint32_t material,
                             const kept_subject *subject, uint64_t key, stored_content *joined);

/// Fails the frame, with a line that names the file of a share, or of a tile that one should have
/// made, and says what is wrong with it.
void passes_kept_fail(const filter_context *context, uint32_t material, uint64_t key,
                      const kept_layout *layout, const char *why);

#endif
