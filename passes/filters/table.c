#include "passes/filters/filters.h"

const lobe_filter *const filter_table[] = {
    &filter_direct, &filter_mipmap,  &filter_toksvig,   &filter_lean, &filter_leadr,
    &filter_lobes,  &filter_moments, &filter_reference, NULL,
};
