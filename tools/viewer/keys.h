#ifndef TOOLS_VIEWER_KEYS_H
#define TOOLS_VIEWER_KEYS_H

#include <stddef.h>

struct viewer;

/// The action of a key or a gesture. The help in the window, the manual page and the program all
/// use one table.
typedef struct viewer_key {
    int key;             ///< GLFW's number; 0: a gesture of the mouse, or keys that are held
    const char *name;    ///< "F1"
    const char *summary; ///< one phrase
    void (*press)(struct viewer *v);
} viewer_key;

extern const viewer_key viewer_keys[];
extern const size_t viewer_key_count;

/// Performs the action of the key, if it is in the table.
void viewer_keys_press(struct viewer *v, int key);

/// How far the held keys move the camera in this time: to the right, upwards, forwards; as
/// fractions of the distance to the target. False: none is held.
bool viewer_keys_fly(const struct viewer *v, double seconds, double steps[3]);

#endif
