#include "passes/context/sample_count.h"

#include <math.h>

#include "passes/context/knob_values.h"
#include "passes/context/sample_pattern.h"
#include "passes/context/shared_knobs.h"

#define AUTOMATIC 4 ///< choice of the knob; those before it are powers of two

sample_count passes_sample_count(const filter_context *context) {
    const uint32_t choice =
        context->filter->supersamples ? 0 : passes_knob_choice(context, &passes_knob_samples);
    sample_count count = {.everywhere = choice != AUTOMATIC};
    count.most = count.everywhere ? 1u << choice : SAMPLES_AROUND_CENTRE;
    count.footprint = 1 / sqrtf((float)count.most);
    return count;
}
