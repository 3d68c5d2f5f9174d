#include "passes/filters/filter.h"

// A line for each filter, in the order of `lobe filters`. Its entry is passes_filter_NAME.
#define FILTERS                                                                                    \
    FILTER(direct)                                                                                 \
    FILTER(mipmap)                                                                                 \
    FILTER(toksvig)                                                                                \
    FILTER(lean)                                                                                   \
    FILTER(leadr)                                                                                  \
    FILTER(lobes)                                                                                  \
    FILTER(moments)                                                                                \
    FILTER(reference)

#define FILTER(name) extern const lobe_filter passes_filter_##name;
FILTERS
#undef FILTER

#define FILTER(name) &passes_filter_##name,
const lobe_filter *const passes_filter_table[] = {FILTERS NULL};
