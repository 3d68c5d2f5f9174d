#include "tools/cli/number_text.h"

#include <math.h>
#include <stdio.h>

/// Digits after the point; rounding may still add one before it: 0.9996 is 1.000.
static int decimals(double value, int significant) {
    char scientific[32];
    int exponent;
    snprintf(scientific, sizeof scientific, "%.*e", significant - 1, value);
    sscanf(scientific, "%*[^e]e%d", &exponent);
    int count = significant - 1 - exponent;
    return count < 0 ? 0 : count > 9 ? 9 : count;
}

number_text number_text_of(double value, int significant) {
    number_text result;
    if (isnan(value))
        snprintf(result.text, sizeof result.text, "–");
    else if (isinf(value) || fabs(value) >= 1e18)
        snprintf(result.text, sizeof result.text, value > 0 ? "∞" : "−∞");
    else if (value == 0)
        snprintf(result.text, sizeof result.text, "0");
    else
        snprintf(result.text, sizeof result.text, "%.*f", decimals(value, significant), value);
    return result;
}
