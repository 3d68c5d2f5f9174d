#ifndef THIRD_PARTY_OPENEXR_H
#define THIRD_PARTY_OPENEXR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Scan lines of OpenEXR files through the C++ library, for what OpenEXRCore cannot decode: the
/// compressions DWAA and DWAB, up to version 3.1.

#define OPENEXR_MESSAGE_SIZE 200

typedef struct openexr_source {
    const void *bytes; ///< a whole file, whose header OpenEXRCore has accepted
    size_t size;
    int part;                ///< of scan lines or tiles; of several levels the finest is read
    const char *channels[4]; ///< full names, not subsampled; NULL: none, its numbers are 1
    /// Takes row `y`, in the file's own coordinates, from the top of the data window to its end:
    /// four numbers per texel, over the window's width. Must not throw.
    void (*place)(void *user, int y, const float *row);
    void *user;
} openexr_source;

/// False: `message` says why (damaged, out of memory), in printable ASCII; some rows may have been
/// placed before.
bool third_party_openexr_read(const openexr_source *source, char message[OPENEXR_MESSAGE_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
