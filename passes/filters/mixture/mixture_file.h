#ifndef PASSES_FILTERS_MIXTURE_MIXTURE_FILE_H
#define PASSES_FILTERS_MIXTURE_MIXTURE_FILE_H

#include <stdbool.h>

#include <lobe/graph.h>
#include <lobe/host.h>

#include "passes/filters/mixture/mixture_map.h"
#include "shaders/interface/moment_bins.h"

/// Maps of mixtures as files of a folder, so that a material need not be fitted again. A file is
/// named after a digest of what its map was made from. It holds the map's texels as they are on the
/// device. Files may be removed at any time.

/// Increment it whenever the same material is fitted or stored differently: old files are then no
/// longer found.
#define MIXTURE_FILE_VERSION 3

/// Texels of a row: levels, and within a level layers, follow each other in rows of so many texels.
#define MIXTURE_FILE_ROW 4096

/// A map in host memory.
typedef struct mixture_image {
    uint8_t *file; ///< owned: all that was read
    struct moment_binning_constants bins;
    lobe_image rows; ///< within `file`: not to be freed on their own
} mixture_image;

/// Rows that a map takes.
uint32_t passes_mixture_rows(const mixture_extent *extent);

/// Loads the map of a key. False if the folder has none, or (with a notice) only a damaged or
/// foreign file. On true the caller frees the map with passes_mixture_image_free.
bool passes_mixture_file_load(const char *folder, uint64_t key, const mixture_extent *extent,
                              const lobe_host *host, mixture_image *image);
/// Zeroes the structure.
void passes_mixture_image_free(mixture_image *image);

/// Saves a map. `texels`: level by level, layer by layer. Logs a warning if that fails.
void passes_mixture_file_save(const char *folder, uint64_t key, const mixture_extent *extent,
                              const struct moment_binning_constants *bins, const void *texels,
                              const lobe_host *host);

#endif
