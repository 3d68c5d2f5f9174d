#ifndef TOOLS_CHOICE_TRADE_CHOICE_H
#define TOOLS_CHOICE_TRADE_CHOICE_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/sweep/results.h"

/// Chooses filter and knobs by their two costs, time and error: one is limited, the other is
/// minimised.

typedef enum trade_limit {
    TRADE_LIMIT_MILLISECONDS, ///< the least error within a time
    TRADE_LIMIT_ERROR,        ///< the least time for at most this error, relative L2
} trade_limit;

typedef struct trade_request {
    trade_limit kind;
    double limit;  ///< inclusive
    bool retained; ///< counts frames with retained maps; otherwise frames that build them all
    /// Pixels of the frame per pixel of the timed frames, above 0. Unless it is 1, the time of
    /// shading is scaled by it, and the time of building is unchanged.
    double pixels;
} trade_request;

typedef struct trade_choice {
    const sweep_row *picked;  ///< NULL: none is within the limit
    const sweep_row *nearest; ///< has the least limited cost; NULL: there are no candidates
    /// Among those with a lower minimised cost than the picked one, and thus beyond the limit, the
    /// one with the least limited cost. NULL: nothing is better, or nothing was picked.
    const sweep_row *better;
    size_t candidates; ///< rows with a time above 0 and an error
    size_t within;     ///< those of them within the limit
} trade_choice;

/// The expected time of a frame; NAN or not above 0 if unknown.
double trade_milliseconds(const trade_request *request, const sweep_row *row);

/// Chooses among rows of one scene. Among rows with equal minimised cost the one with less limited
/// cost is picked; if both are equal, the first.
trade_choice trade_choose(const trade_request *request, const sweep_row *const *rows, size_t count);

#endif
