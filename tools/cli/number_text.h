#ifndef TOOLS_CLI_NUMBER_TEXT_H
#define TOOLS_CLI_NUMBER_TEXT_H

/// A number for people: with this many significant digits, no exponent, and the complete integer
/// part: 0.00123, 0.163, 14.2, 1623.
typedef struct number_text {
    char text[32]; ///< UTF-8; a dash for NaN, a sign for infinity
} number_text;

/// `significant`: [1, 9] digits.
number_text number_text_of(double value, int significant);

#endif
