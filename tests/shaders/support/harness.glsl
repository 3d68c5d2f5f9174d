// Runs one function of shaders/lib for each element of a buffer: include this file, then define
//   vec4 evaluate(vec4 a, vec4 b, vec4 c)
// which chooses by FUNCTION.

layout(constant_id = 0) const uint FUNCTION = 0;

layout(local_size_x = 64) in;

struct function_arguments {
    vec4 a, b, c;
};

layout(set = 0, binding = 0, std430) readonly buffer argument_block {
    function_arguments arguments[];
};
layout(set = 0, binding = 1, std430) writeonly buffer result_block {
    vec4 results[];
};

vec4 evaluate(vec4 a, vec4 b, vec4 c);

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < arguments.length())
        results[i] = evaluate(arguments[i].a, arguments[i].b, arguments[i].c);
}
