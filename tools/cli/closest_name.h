#ifndef TOOLS_CLI_CLOSEST_NAME_H
#define TOOLS_CLI_CLOSEST_NAME_H

#include <stddef.h>

/// The candidate that was probably meant by a misspelt name. Set the name, offer all candidates,
/// and add the hint to the message.
typedef struct closest_name {
    const char *name;
    size_t length;       ///< bytes of the name
    const char *closest; ///< NULL: none is close
    size_t edits;        ///< that make the name the closest candidate
} closest_name;

void closest_name_offer(closest_name *closest, const char *candidate);

#define CLOSEST_NAME_HINT_SIZE 96
/// "; did you mean 'PREFIXcandidate'?", or "" if none is close. Returns `hint`.
const char *closest_name_hint(const closest_name *closest, const char *prefix,
                              char hint[CLOSEST_NAME_HINT_SIZE]);

#endif
