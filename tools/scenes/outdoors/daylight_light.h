#ifndef TOOLS_SCENES_DAYLIGHT_LIGHT_H
#define TOOLS_SCENES_DAYLIGHT_LIGHT_H

#include <lobe/host.h>
#include <lobe/scene.h>

#include "scenes/mesh/vector.h"

/// Daylight of a clear day.
typedef struct daylight_light {
    const char *name; ///< of the sky
    vector3 sun;      ///< towards it, of any length
    double turbidity;
    /// Albedo of the ground that the sky shows below the horizon, [0, 1]. Negative: it shows there
    /// what the horizon does.
    double ground;
} daylight_light;

/// Lights a scene with the sun as a directional light, and with the sky without it as the
/// environment, which is visible. As bright as the environment "sky": a white level surface has a
/// luminance of 1.
lobe_result daylight_light_add(lobe_scene *scene, const daylight_light *light,
                               const lobe_host *host);

#endif
