#ifndef LOBE_API_H
#define LOBE_API_H

/// Marks the functions that the library exports. Everything else is hidden.
#if defined(__GNUC__)
#define LOBE_API __attribute__((visibility("default")))
#else
#define LOBE_API
#endif

/// The type in front of the braces of a literal, which C and C++ write differently.
#ifdef __cplusplus
#define LOBE_LITERAL(type) type
#else
#define LOBE_LITERAL(type) (type)
#endif

#endif
