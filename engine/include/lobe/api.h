#ifndef LOBE_API_H
#define LOBE_API_H

/// Marks the functions that the library exports. Everything else is hidden.
#if defined(__GNUC__)
#define LOBE_API __attribute__((visibility("default")))
#else
#define LOBE_API
#endif

#endif
