#ifndef LIB_COORDINATE_FRAME_GLSL
#define LIB_COORDINATE_FRAME_GLSL

// Turns a plane's vectors into the frame of texture coordinates that lie on it: x along u, y at a
// right angle, against v. `dx`, `dy`: change of position to the next pixel, in the plane; `uv_dx`,
// `uv_dy`: that of the coordinates. Of coordinates without area the plane's own frame.
mat2 coordinate_frame(vec2 dx, vec2 dy, vec2 uv_dx, vec2 uv_dy) {
    float area = dx.x * dy.y - dx.y * dy.x;
    float uv_area = uv_dx.x * uv_dy.y - uv_dx.y * uv_dy.x;
    vec2 along_u = dx * uv_dy.y - dy * uv_dx.y;
    along_u *= uv_area < 0.0 ? -1.0 : 1.0;
    float size = max(abs(along_u.x), abs(along_u.y));
    if (!(size > 0.0) || uv_area == 0.0 || area == 0.0)
        return mat2(1.0);
    vec2 x = normalize(along_u / size);
    vec2 y = (area < 0.0) == (uv_area < 0.0) ? vec2(x.y, -x.x) : vec2(-x.y, x.x);
    return transpose(mat2(x, y));
}

#endif
