#version 460
#extension GL_GOOGLE_include_directive : require

// Instances of a batch that may be seen: their transforms, or those that they had in the previous
// frame, in the order that they had, and the arguments of the draw. An instance is left out where
// its bounds lie behind a plane. One workgroup takes a batch, and finds places by prefix sums, so
// that the order never depends on the device.

#include "interface/instance.h"

layout(local_size_x = CULLING_THREADS) in;

layout(push_constant) uniform constants_block {
    culling_constants view;
};
layout(set = 0, binding = 0, std430) readonly buffer batch_block {
    culled_batch batches[];
};
layout(set = 0, binding = 1, std430) readonly buffer transform_block {
    instance_constants transforms[];
};
layout(set = 0, binding = 2, std430) readonly buffer copied_block {
    instance_constants copied[]; // of the same instances
};
layout(set = 0, binding = 3, std430) writeonly buffer seen_block {
    instance_constants seen[];
};
layout(set = 0, binding = 4, std430) writeonly buffer argument_block {
    uint arguments[];
};

// How far rounding may move a vertex, of the size of what is added up.
const float SLACK = 1e-5;

shared uint kept[2][CULLING_THREADS];

bool lies_behind(vec4 plane, instance_constants instance, vec3 middle, vec3 reach) {
    vec3 normal = plane.xyz;
    vec3 local = normal * mat3(vec3(instance.rows[0].x, instance.rows[1].x, instance.rows[2].x),
                               vec3(instance.rows[0].y, instance.rows[1].y, instance.rows[2].y),
                               vec3(instance.rows[0].z, instance.rows[1].z, instance.rows[2].z));
    vec3 place = vec3(instance.rows[0].w, instance.rows[1].w, instance.rows[2].w);
    float farthest = dot(local, middle) + dot(abs(local), reach) + dot(normal, place) + plane.w;
    float size = dot(abs(local), abs(middle) + reach) + dot(abs(normal), abs(place)) + abs(plane.w);
    return farthest < -SLACK * size; // not where either is NaN
}

bool may_be_seen(instance_constants instance, vec3 minimum, vec3 maximum) {
    vec3 middle = 0.5 * minimum + 0.5 * maximum, reach = 0.5 * maximum - 0.5 * minimum;
    bool hidden = false;
    for (int i = 0; i < 4; ++i)
        hidden = hidden || lies_behind(view.planes[i], instance, middle, reach);
    return !hidden;
}

// The number of threads up to and including this one that keep their instance; `all`: of all.
uint count_kept(bool keeps, out uint all) {
    uint local = gl_LocalInvocationIndex, from = 0u;
    barrier(); // the last sums have been read
    kept[from][local] = keeps ? 1u : 0u;
    for (uint distance = 1u; distance < CULLING_THREADS; distance *= 2u) {
        barrier();
        kept[1u - from][local] =
            kept[from][local] + (local >= distance ? kept[from][local - distance] : 0u);
        from = 1u - from;
    }
    barrier();
    all = kept[from][CULLING_THREADS - 1u];
    return kept[from][local];
}

void main() {
    uint number = gl_WorkGroupID.x, local = gl_LocalInvocationIndex, count = 0u;
    culled_batch batch = batches[number];
    for (uint start = 0u; start < batch.count; start += CULLING_THREADS) {
        bool inside = start + local < batch.count;
        uint index = batch.first + min(start + local, batch.count - 1u);
        bool keeps = inside &&
                     may_be_seen(transforms[index], batch.minimum.xyz, batch.maximum.xyz);
        uint all;
        uint place = count_kept(keeps, all);
        if (keeps)
            seen[batch.first + count + place - 1u] = copied[index];
        count += all;
    }
    if (local > 0u)
        return;
    uint record = view.first_record + number;
    arguments[5u * record] = batch.index_count;
    arguments[5u * record + 1u] = count;
    for (uint i = 2u; i < 5u; ++i)
        arguments[5u * record + i] = 0u;
}
