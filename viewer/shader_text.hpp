// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace geomap::viewer {

inline constexpr const char* kFillVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 clip_from_buffer;
out vec4 vertex_color;
void main() {
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  vertex_color = color;
})";

inline constexpr const char* kFillFragment = R"(#version 330 core
in vec4 vertex_color;
uniform vec4 front, back;
out vec4 pixel;
void main() { pixel = vertex_color * (gl_FrontFacing ? front : back); })";

// Many surfaces at once, each with its own row of the table: front, back, outline, half width.
inline constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 3) in uint surface;
uniform mat4 clip_from_buffer;
uniform samplerBuffer styles;
flat out vec4 front, back;
void main() {
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  front = texelFetch(styles, 4 * int(surface));
  back = texelFetch(styles, 4 * int(surface) + 1);
})";

inline constexpr const char* kSurfaceFragment = R"(#version 330 core
flat in vec4 front, back;
out vec4 pixel;
void main() { pixel = gl_FrontFacing ? front : back; })";

inline constexpr const char* kSurfaceLineVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 2) in float along;
layout(location = 3) in uint surface;
uniform mat4 clip_from_buffer;
uniform samplerBuffer styles;
out vec4 end_color;
out float end_along, end_half_width;
void main() {
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  end_color = texelFetch(styles, 4 * int(surface) + 2);
  end_half_width = texelFetch(styles, 4 * int(surface) + 3).x;
  end_along = along;
})";

inline constexpr const char* kLineVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 2) in float along;
uniform mat4 clip_from_buffer;
uniform vec4 tint;
uniform float half_width;
out vec4 end_color;
out float end_along, end_half_width;
void main() {
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  end_color = color * tint;
  end_half_width = half_width;
  end_along = along;
})";

// A line becomes a rectangle that faces the eye. What is behind the near plane is cut off first:
// its place on the screen would mean nothing.
inline constexpr const char* kLineGeometry = R"(#version 330 core
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
in vec4 end_color[];
in float end_along[], end_half_width[];
uniform vec2 viewport;
out vec4 line_color;
out float line_along;
noperspective out float across;
flat out float line_reach;

void emit(vec4 clip, vec2 shift, vec4 color, float along, float side) {
  gl_Position = clip + vec4(2.0 * shift / viewport * clip.w, 0.0, 0.0);
  line_color = color;
  line_along = along;
  across = side;
  line_reach = abs(side);
  EmitVertex();
}

void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  float from = a.z + a.w, to = b.z + b.w;
  if (from <= 0.0 && to <= 0.0) return;
  float start = from < 0.0 ? from / (from - to) : 0.0;
  float end = to < 0.0 ? from / (from - to) : 1.0;
  vec4 p = mix(a, b, start), q = mix(a, b, end);
  vec2 way = (q.xy / q.w - p.xy / p.w) * viewport;
  vec2 direction = length(way) > 1e-4 ? normalize(way) : vec2(1.0, 0.0);
  float half_width = end_half_width[0];
  float reach = half_width + 0.5;
  vec2 aside = reach * vec2(-direction.y, direction.x);
  vec2 onward = 0.5 * half_width * direction;
  vec4 p_color = mix(end_color[0], end_color[1], start);
  vec4 q_color = mix(end_color[0], end_color[1], end);
  float p_along = mix(end_along[0], end_along[1], start);
  float q_along = mix(end_along[0], end_along[1], end);
  emit(p, aside - onward, p_color, p_along, reach);
  emit(p, -aside - onward, p_color, p_along, -reach);
  emit(q, aside + onward, q_color, q_along, reach);
  emit(q, -aside + onward, q_color, q_along, -reach);
  EndPrimitive();
})";

inline constexpr const char* kLineFragment = R"(#version 330 core
in vec4 line_color;
in float line_along;
noperspective in float across;
flat in float line_reach;
uniform float dash;
out vec4 pixel;
void main() {
  float cover = clamp(line_reach - abs(across), 0.0, 1.0);
  if (dash > 0.0 && fract(line_along / dash) > 0.55) discard;
  pixel = line_color;
  pixel.a *= cover;
  if (pixel.a < 0.02) discard;
})";

inline constexpr const char* kPointVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 clip_from_buffer;
uniform vec4 height_row, hidden_row, veil, clip_backwards;
uniform vec4 ramp[9];
uniform float size, by_height, hides;
out vec4 vertex_color;
void main() {
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  // Only the depth is that of a place farther back, so that surfaces through the points cover them.
  vec4 farther = gl_Position + clip_backwards;
  if (gl_Position.w > 0.0) {
    gl_Position.z = min(farther.z / farther.w, 0.99999) * gl_Position.w;
  }
  // Outside of the view, where nothing is drawn.
  bool is_above = dot(hidden_row, vec4(position, 1.0)) > 0.0;
  if (hides > 0.5 && is_above) gl_Position = vec4(9.0, 9.0, 9.0, 1.0);
  gl_PointSize = size;
  float at = 8.0 * clamp(dot(height_row, vec4(position, 1.0)), 0.0, 1.0);
  int below = min(int(at), 7);
  vec4 height_color = mix(ramp[below], ramp[below + 1], at - float(below));
  vec3 plain = by_height > 0.5 ? height_color.rgb : color.rgb;
  vertex_color = vec4(mix(plain, veil.rgb, veil.a), 1.0);
})";

inline constexpr const char* kPointFragment = R"(#version 330 core
in vec4 vertex_color;
uniform float is_round;
out vec4 pixel;
void main() {
  vec2 off = 2.0 * gl_PointCoord - 1.0;
  if (is_round > 0.5 && dot(off, off) > 1.0) discard;
  pixel = vertex_color;
})";

}  // namespace geomap::viewer
