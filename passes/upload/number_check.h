#ifndef PASSES_UPLOAD_NUMBER_CHECK_H
#define PASSES_UPLOAD_NUMBER_CHECK_H

#include <stddef.h>

#include <lobe/host.h>

/// Whose numbers are checked, for messages: "hall: light 2: intensity[0] is nan; ...".
typedef struct number_owner {
    const lobe_host *host;
    const char *where; ///< the scene's name, or the call
    const char *kind;  ///< "light"
    const char *name;  ///< of the object; NULL: it has none
    size_t index;      ///< of an object without a name; SIZE_MAX: there is only one
} number_owner;

/// "light 2", "material 'brass'", "camera".
void passes_print_owner(const number_owner *owner, char *text, size_t size);
/// Checks that numbers of an object are finite and in [minimum, maximum], which may be infinite. Of
/// numbers without maximum, the minimum is 0, or FLT_MIN for those above 0.
/// The first one that is not is logged in one line, and LOBE_ERROR_MALFORMED is returned.
lobe_result passes_check_numbers(const number_owner *owner, const char *member, const float *values,
                                 size_t count, double minimum, double maximum);
lobe_result passes_check_number(const number_owner *owner, const char *member, double value,
                                double minimum, double maximum);
/// Checks that a vector has unit length, within rounding.
lobe_result passes_check_direction(const number_owner *owner, const char *member,
                                   const float vector[3]);
/// Logs "... : member is (x, y, z); expectation" and returns LOBE_ERROR_MALFORMED.
lobe_result passes_fail_vector(const number_owner *owner, const char *member, const float vector[3],
                               const char *expectation);

#endif
