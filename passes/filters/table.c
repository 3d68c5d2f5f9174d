#include "passes/filters/filters.h"

const lobe_filter *const passes_filter_table[] = {
    &passes_filter_direct,  &passes_filter_mipmap,    &passes_filter_toksvig,
    &passes_filter_lean,    &passes_filter_leadr,     &passes_filter_lobes,
    &passes_filter_moments, &passes_filter_reference, NULL,
};
