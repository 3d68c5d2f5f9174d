#ifndef PASSES_MAPS_KEPT_KEPT_FILE_H
#define PASSES_MAPS_KEPT_KEPT_FILE_H

#include <stdbool.h>

#include <lobe/graph.h>
#include <lobe/host.h>

/// What takes seconds to make of a material, as files of a folder, so that it need not be made
/// again. A file is named after a digest of all that it was made from, and holds images and buffers
/// as they are on the device. Files may be removed at any time.

#define KEPT_MAXIMUM_IMAGES  2
#define KEPT_MAXIMUM_BUFFERS 3

/// Texels of a row: levels, and within a level layers, follow each other in rows of so many texels.
#define KEPT_FILE_ROW 4096

/// An image with all its levels, each half of the one before.
typedef struct kept_image {
    lobe_format format;
    uint32_t width, height; ///< texels of level 0
    uint32_t layers, levels;
} kept_image;

/// What a file holds: images and buffers, of these at least one.
typedef struct kept_layout {
    const char *what; ///< in messages, and the ending of files: letters
    kept_image images[KEPT_MAXIMUM_IMAGES];
    uint32_t image_count;
    uint32_t buffer_bytes[KEPT_MAXIMUM_BUFFERS]; ///< multiples of four, not 0
    uint32_t buffer_count;
    /// The file is one of several, counted from 1 on; 0, 0: the only one. A tile is a part of what
    /// is kept; a share is a part of what that is made from.
    uint32_t tile, tiles;
    uint32_t share, shares;
} kept_layout;

/// A file in host memory.
typedef struct kept_content {
    uint8_t *file;                             ///< owned: all that was read
    lobe_image rows[KEPT_MAXIMUM_IMAGES];      ///< within `file`: not to be freed on their own
    const void *buffers[KEPT_MAXIMUM_BUFFERS]; ///< within `file`
} kept_content;

/// Rows that an image takes.
uint32_t passes_kept_rows(const kept_image *image);

/// Bytes of all images and buffers in a file.
uint64_t passes_kept_bytes(const kept_layout *layout);

/// Whether the folder has a file of this name.
bool passes_kept_file_is_there(const char *folder, uint64_t key, const kept_layout *layout,
                               const lobe_host *host);

/// Loads the file of a key. False if the folder has none, or (with a notice) only a damaged or
/// foreign one. On true the caller frees the content with passes_kept_content_free.
bool passes_kept_file_load(const char *folder, uint64_t key, const kept_layout *layout,
                           const lobe_host *host, kept_content *content);
/// Says (a notice) why a file that was loaded is not used.
void passes_kept_file_decline(const char *folder, uint64_t key, const kept_layout *layout,
                              const char *why, const lobe_host *host);
/// Zeroes the structure.
void passes_kept_content_free(kept_content *content);

/// Saves a file. `images`: of each, texels level by level, layer by layer. False, with a warning,
/// if that fails.
bool passes_kept_file_save(const char *folder, uint64_t key, const kept_layout *layout,
                           const void *const *images, const void *const *buffers,
                           const lobe_host *host);

/// Removes a file, if it is there.
void passes_kept_file_remove(const char *folder, uint64_t key, const kept_layout *layout,
                             const lobe_host *host);

/// The path of a file. The caller frees it with lobe_release. NULL if out of memory.
char *passes_kept_file_path(const char *folder, uint64_t key, const kept_layout *layout,
                            const lobe_host *host);

#endif
