#ifndef TOOLS_ENVIRONMENT_OUTPUT_H
#define TOOLS_ENVIRONMENT_OUTPUT_H

#include <lobe/environment_maps.h>

/// Results of preparing an environment, for people and for other programs.
typedef struct environment_output {
    const lobe_environment *environment;
    lobe_environment_maps *maps;
    lobe_environment_map map; ///< a filtered one
    uint32_t size;            ///< texels along a face of the radiance
    const lobe_host *host;
} environment_output;

/// Prints a table of the map's levels, and the times of the passes that made all maps, on standard
/// output.
void environment_output_print(const environment_output *output);

/// Writes the map as an OpenEXR file of levels, with attributes that describe each of them.
lobe_result environment_output_write(const environment_output *output, const char *path);

#endif
