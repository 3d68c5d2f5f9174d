#version 460

// Writes the arguments of the passes that take further samples: groups of 64 for one dispatch, then
// the counts of each draw. If no pixel takes any, there are no groups and no instances.

layout(local_size_x = 64) in;

layout(push_constant) uniform constants_block { uint draws; };
layout(set = 0, binding = 0, std430) readonly buffer list_block { uint list[]; };
// Of each draw: indices (or vertices), instances, and 1 + the record of arguments that has the
// instances that are seen; 0: all of them.
layout(set = 0, binding = 1, std430) readonly buffer count_block { uint counts[]; };
layout(set = 0, binding = 2, std430) readonly buffer seen_block { uint seen[]; };
layout(set = 0, binding = 3, std430) writeonly buffer argument_block { uint arguments[]; };

void write(uint record, uint a, uint b, uint c) {
    arguments[5u * record] = a;
    arguments[5u * record + 1u] = b;
    arguments[5u * record + 2u] = c;
    arguments[5u * record + 3u] = 0u;
    arguments[5u * record + 4u] = 0u;
}

uint instances_of(uint draw) {
    uint record = counts[3u * draw + 2u];
    return record > 0u ? seen[5u * (record - 1u) + 1u] : counts[3u * draw + 1u];
}

void main() {
    uint record = gl_GlobalInvocationID.x;
    if (record == 0u) {
        // Every device allows 65535 groups in a dimension.
        uint groups = (list[0] + 63u) / 64u;
        write(0u, min(groups, 65535u), (groups + 65534u) / 65535u, 1u);
    }
    else if (record <= draws)
        write(record, counts[3u * (record - 1u)], list[0] > 0u ? instances_of(record - 1u) : 0u,
              0u);
}
