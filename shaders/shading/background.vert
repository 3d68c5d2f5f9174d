#version 460

// One triangle over the whole picture, farther than everything and yet nearer than cleared depth.

layout(location = 0) out vec2 clip_position;

void main() {
    clip_position = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(clip_position, 1e-30, 1.0);
}
