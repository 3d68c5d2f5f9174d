#ifndef TOOLS_CHOICE_TRADE_CHOICE_H
#define TOOLS_CHOICE_TRADE_CHOICE_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/sweep/results.h"

/// Which filter and knobs to take, by what each costs: time and error. One is limited, of the
/// other the least is wanted.

typedef enum trade_limit {
    TRADE_LIMIT_MILLISECONDS, ///< the least error in so much time
    TRADE_LIMIT_ERROR,        ///< the least time for an error of at most so much, relative L2
} trade_limit;

typedef struct trade_request {
    trade_limit kind;
    double limit;  ///< included
    bool retained; ///< counts frames that find their maps ready; else those that build them all
    /// Pixels of the frame for each pixel of those that were timed, above 0. Where it is not 1,
    /// shading is taken to need as much longer, and building as long as it did.
    double pixels;
} trade_request;

typedef struct trade_choice {
    const sweep_row *picked;  ///< NULL: none is within the limit
    const sweep_row *nearest; ///< costs least of what is limited; NULL: there are no candidates
    /// Of those that are better than what was picked in what is wanted, and so beyond the limit:
    /// the one that costs least of what is limited. NULL: nothing is better, or nothing picked.
    const sweep_row *better;
    size_t candidates; ///< rows with a time above 0 and an error
    size_t within;     ///< those of them within the limit
} trade_choice;

/// What a frame is expected to take; not above 0 or NAN where that is not known.
double trade_milliseconds(const trade_request *request, const sweep_row *row);

/// Chooses among rows of one scene. Of those that are equal in what is wanted the one that costs
/// less of what is limited is picked, of those that are equal in both the first.
trade_choice trade_choose(const trade_request *request, const sweep_row *const *rows, size_t count);

#endif
