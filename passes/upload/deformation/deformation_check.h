#ifndef PASSES_UPLOAD_DEFORMATION_CHECK_H
#define PASSES_UPLOAD_DEFORMATION_CHECK_H

#include <lobe/host.h>
#include <lobe/scene.h>

#include "passes/upload/number_check.h"

/// Checks what a mesh's deformation has besides its pose: memory, indices and numbers. A mesh may
/// have none. LOBE_ERROR_MALFORMED, LOBE_ERROR_LIMIT.
lobe_result passes_check_deformation(const number_owner *owner, const lobe_mesh *mesh);

/// Checks the poses of all meshes, which are read in every frame. LOBE_ERROR_MALFORMED.
lobe_result passes_check_poses(const lobe_scene *scene, const lobe_host *host);

#endif
