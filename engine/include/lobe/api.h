#ifndef LOBE_API_H
#define LOBE_API_H

/// Marks each function that the library exports. Everything else in it is hidden.
#if defined(__GNUC__)
#define LOBE_API __attribute__((visibility("default")))
#else
#define LOBE_API
#endif

#endif
