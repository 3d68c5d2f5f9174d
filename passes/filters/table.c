#include "passes/context/filter.h"

// One line per filter, in the order of `lobe filters`; each refers to passes_filter_NAME.
#define FILTERS                                                                                    \
    FILTER(direct)                                                                                 \
    FILTER(mipmap)                                                                                 \
    FILTER(toksvig)                                                                                \
    FILTER(lean)                                                                                   \
    FILTER(leadr)                                                                                  \
    FILTER(multi_leadr)                                                                            \
    FILTER(lobes)                                                                                  \
    FILTER(moments)                                                                                \
    FILTER(tan)                                                                                    \
    FILTER(mixture)                                                                                \
    FILTER(fournier)                                                                               \
    FILTER(displaced)                                                                              \
    FILTER(wu)                                                                                     \
    FILTER(reference)                                                                              \
    FILTER(displaced_reference)

#define FILTER(name) extern const lobe_filter passes_filter_##name;
FILTERS
#undef FILTER

#define FILTER(name) &passes_filter_##name,
const lobe_filter *const passes_filter_table[] = {FILTERS NULL};
