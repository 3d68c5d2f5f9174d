#ifndef INTERFACE_REFLECTED_RINGS_H
#define INTERFACE_REFLECTED_RINGS_H

// Rings of half vectors in sums over what microfacets reflect: a thread each.
#define REFLECTED_RINGS 48

#endif
