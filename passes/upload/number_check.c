#include "passes/upload/number_check.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

void passes_print_owner(const number_owner *owner, char *text, size_t size) {
    if (owner->name)
        snprintf(text, size, "%s '%.128s'", owner->kind, owner->name);
    else if (owner->index != SIZE_MAX)
        snprintf(text, size, "%s %zu", owner->kind, owner->index);
    else
        snprintf(text, size, "%s", owner->kind);
}

static void print_range(double minimum, double maximum, char *text, size_t size) {
    if (minimum > 0 && !isfinite(maximum))
        snprintf(text, size, "a finite number above 0");
    else if (isfinite(minimum) && isfinite(maximum))
        snprintf(text, size, "a number in [%g, %g]", minimum, maximum);
    else if (isfinite(minimum))
        snprintf(text, size, "a finite number of at least %g", minimum);
    else
        snprintf(text, size, "a finite number");
}

lobe_result passes_check_number(const number_owner *owner, const char *member, double value,
                                double minimum, double maximum) {
    if (isfinite(value) && value >= minimum && value <= maximum)
        return LOBE_OK;
    char object[160], range[64];
    passes_print_owner(owner, object, sizeof object);
    print_range(minimum, maximum, range, sizeof range);
    return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED, "%s: %s: %s is %g; expected %s",
                          owner->where, object, member, value, range);
}

lobe_result passes_check_numbers(const number_owner *owner, const char *member, const float *values,
                                 size_t count, double minimum, double maximum) {
    for (size_t i = 0; i < count; i++) {
        const double value = values[i];
        if (isfinite(value) && value >= minimum && value <= maximum)
            continue;
        char element[64];
        snprintf(element, sizeof element, "%s[%zu]", member, i);
        return passes_check_number(owner, element, value, minimum, maximum);
    }
    return LOBE_OK;
}

lobe_result passes_fail_vector(const number_owner *owner, const char *member, const float vector[3],
                               const char *expectation) {
    char object[160];
    passes_print_owner(owner, object, sizeof object);
    return lobe_host_fail(owner->host, LOBE_ERROR_MALFORMED, "%s: %s: %s is (%g, %g, %g); %s",
                          owner->where, object, member, (double)vector[0], (double)vector[1],
                          (double)vector[2], expectation);
}

lobe_result passes_check_direction(const number_owner *owner, const char *member,
                                   const float vector[3]) {
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (double)vector[i] * vector[i];
    if (fabs(square - 1) < 1e-3)
        return LOBE_OK;
    return passes_fail_vector(owner, member, vector, "expected a vector of unit length");
}
