#version 460

// One step from a place to a goal, and whether it was there already.

layout(local_size_x = 1) in;

layout(set = 0, binding = 0) readonly buffer source_block { uint goal; };
layout(set = 0, binding = 1) buffer state_block { uint place, rests; };

void main() {
    uint next = min(place + 1u, goal);
    rests = next == place ? 1u : 0u;
    place = next;
}
