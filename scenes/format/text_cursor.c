#include "scenes/format/text_cursor.h"

#include <float.h>
#include <math.h>
#include <stdint.h>

// Digits beyond the precision of a double are skipped; their places still count.
#define MAXIMUM_MANTISSA (UINT64_C(1) << 53)

static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_digit(const text_cursor *cursor) {
    return cursor->at < cursor->end && *cursor->at >= '0' && *cursor->at <= '9';
}

static bool next_is(text_cursor *cursor, char a, char b) {
    bool found = cursor->at < cursor->end && (*cursor->at == a || *cursor->at == b);
    cursor->at += found;
    return found;
}

// The characters after a number may make it invalid: "1.2.3", "12abc".
static bool is_ended(const text_cursor *cursor) {
    if (cursor->at == cursor->end)
        return true;
    char c = *cursor->at;
    return !(c == '.' || c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
             (c >= 'A' && c <= 'Z'));
}

void scenes_text_cursor_skip_space(text_cursor *cursor) {
    while (cursor->at < cursor->end && is_space(*cursor->at))
        cursor->at++;
}

bool scenes_text_cursor_take(text_cursor *cursor, char expected) {
    scenes_text_cursor_skip_space(cursor);
    return next_is(cursor, expected, expected);
}

// Appends digits to the mantissa; returns how many there were, and in `*ignored` how many of them
// the mantissa has no room for.
static int read_digits(text_cursor *cursor, uint64_t *mantissa, int *ignored) {
    int count = 0;
    for (; is_digit(cursor) && count < 10000; cursor->at++, count++) {
        if (*mantissa < MAXIMUM_MANTISSA / 10)
            *mantissa = *mantissa * 10 + (uint64_t)(*cursor->at - '0');
        else
            ++*ignored;
    }
    return count;
}

static bool read_exponent(text_cursor *cursor, int *exponent) {
    uint64_t digits = 0;
    int ignored = 0;
    if (!next_is(cursor, 'e', 'E'))
        return true;
    bool negative = next_is(cursor, '-', '-');
    if (!negative)
        next_is(cursor, '+', '+');
    if (read_digits(cursor, &digits, &ignored) == 0)
        return false;
    int magnitude = digits > 10000 ? 10000 : (int)digits;
    *exponent += negative ? -magnitude : magnitude;
    return true;
}

// Clinger 1990, "How to Read Floating Point Numbers Accurately": both operands are exact up to
// 10^22, so one division or product rounds only once. Beyond that the error stays far below
// float's.
static double scale(uint64_t mantissa, int exponent) {
    double value = (double)mantissa, power = 1;
    if (mantissa == 0)
        return 0;
    for (int left = exponent < 0 ? -exponent : exponent; left > 0 && power < 1e300; left--)
        power *= 10;
    return exponent < 0 ? value / power : value * power;
}

bool scenes_text_cursor_number(text_cursor *cursor, double *value) {
    text_cursor copy = *cursor;
    uint64_t mantissa = 0;
    int exponent = 0, ignored = 0;
    scenes_text_cursor_skip_space(&copy);
    bool negative = next_is(&copy, '-', '-');
    if (!negative)
        next_is(&copy, '+', '+');
    int digits = read_digits(&copy, &mantissa, &exponent);
    if (next_is(&copy, '.', '.')) {
        int places = read_digits(&copy, &mantissa, &ignored);
        exponent -= places - ignored;
        digits += places;
    }
    if (digits == 0 || !read_exponent(&copy, &exponent) || !is_ended(&copy))
        return false;
    double magnitude = scale(mantissa, exponent);
    if (!(magnitude <= (double)FLT_MAX))
        return false;
    *value = negative ? -magnitude : magnitude;
    *cursor = copy;
    return true;
}

bool scenes_text_cursor_integer(text_cursor *cursor, size_t maximum, size_t *value) {
    text_cursor copy = *cursor;
    scenes_text_cursor_skip_space(&copy);
    if (!is_digit(&copy))
        return false;
    size_t sum = 0;
    for (; is_digit(&copy); copy.at++) {
        size_t digit = (size_t)(*copy.at - '0');
        if (digit > maximum || sum > (maximum - digit) / 10)
            return false;
        sum = sum * 10 + digit;
    }
    if (!is_ended(&copy))
        return false;
    *value = sum;
    *cursor = copy;
    return true;
}

size_t scenes_text_cursor_line(const text_cursor *cursor, const char *begin) {
    size_t line = 1;
    for (; begin < cursor->at; begin++)
        line += *begin == '\n';
    return line;
}
