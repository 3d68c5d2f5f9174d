#ifndef TOOLS_CLI_CONSOLE_H
#define TOOLS_CLI_CONSOLE_H

#include <stdbool.h>

#include <lobe/host.h>

/// The log of a program at a terminal: errors, warnings and notices go to standard error, one line
/// each ("lobe: error: ..."); debug messages only if `verbose`.
lobe_host console_host(bool verbose);

#endif
