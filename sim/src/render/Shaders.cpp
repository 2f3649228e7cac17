#include "Shaders.hpp"

namespace ortung::shaders {

// Positions are relative to the camera, with the field's axes, so single precision is enough
// everywhere. Alpha is the share of a pixel that is not floor, for TurfPattern.
const char* const kHead = R"glsl(
uniform mat4 toClip;
uniform vec3 light;       // towards it
uniform float ambient;
uniform vec3 lightColour;
)glsl";

const char* const kFloorVertex = R"glsl(
layout(location = 0) in vec3 place;
uniform vec3 origin;  // of the scene's middle from the camera
void main() {
  gl_Position = toClip * vec4(place + origin, 1.0);
}
)glsl";

const char* const kFloorFragment = R"glsl(
layout(location = 0) out vec4 colour;
uniform vec4 paint;
void main() { colour = paint; }
)glsl";

// A piece of a line grows by about a pixel to all sides, as far as that is on the floor there.
const char* const kLineVertex = R"glsl(
layout(location = 0) in vec4 middle;  // x, y, and the direction to the left
layout(location = 1) in vec4 edge;    // out of the line's ends, side, half width
layout(location = 2) in vec2 way;     // along the line, its length
layout(location = 3) in vec4 paint;
uniform vec3 origin;
uniform float pixel;                  // its size at a distance of 1
out vec4 inLine;                      // across, half width, along, length
flat out vec3 tint;
void main() {
  vec3 p = vec3(middle.xy, 0.0) + origin;
  float d = length(p);
  // A pixel covers more of the floor the farther away it is, above all away from the camera.
  float size = pixel * max((toClip * vec4(p, 1.0)).w, 0.25 * d);
  float stretch = d / max(abs(p.z), 0.05);
  vec2 away = p.xy / max(length(p.xy), 1e-3);
  float grown = min(size * (1.0 + stretch * (edge.w < 0.0 ? 1.0 : abs(dot(middle.zw, away)))), 4.0);
  float ends = min(size * (1.0 + stretch * abs(dot(edge.xy, away))), 4.0);
  if (edge.w < 0.0) {  // a spot
    vec2 corner = vec2(edge.z, edge.x) * (grown - edge.w);
    p.xy += corner;
    inLine = vec4(corner.x, edge.w, corner.y, 0.0);
  } else {
    float across = edge.z * (edge.w + grown);
    p.xy += middle.zw * across + edge.xy * ends;
    float out_ = dot(edge.xy, vec2(middle.w, -middle.z));
    inLine = vec4(across, edge.w, way.x + ends * out_, way.y);
  }
  tint = paint.rgb;
  gl_Position = toClip * vec4(p, 1.0);
}
)glsl";

// How much of a pixel the line covers: a pixel is a box across the edge.
const char* const kLineFragment = R"glsl(
in vec4 inLine;
flat in vec3 tint;
float slope(float value) { return length(vec2(dFdx(value), dFdy(value))) + 1e-6; }
float covered() {
  if (inLine.y < 0.0) {
    float from = length(inLine.xz);
    float widest = max(slope(inLine.x), slope(inLine.z));
    return clamp(0.5 - (from + inLine.y) / slope(from), 0.0, 1.0) *
           min(1.0, -2.0 * inLine.y / widest);
  }
  float g = slope(inLine.x);
  float e = slope(inLine.z);
  float across = clamp((inLine.x + inLine.y) / g + 0.5, 0.0, 1.0) -
                 clamp((inLine.x - inLine.y) / g + 0.5, 0.0, 1.0);
  float along = clamp(inLine.z / e + 0.5, 0.0, 1.0) -
                clamp((inLine.z - inLine.w) / e + 0.5, 0.0, 1.0);
  return across * along;
}
layout(location = 0) out vec4 colour;
void main() { colour = vec4(tint * lightColour, covered()); }
)glsl";

const char* const kSolidVertex = R"glsl(
layout(location = 0) in vec3 place;   // of the unit shape
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 matrix;  // row by row
layout(location = 3) in vec4 stands;  // x, y, low and high z, from the camera
layout(location = 4) in vec4 paint;
layout(location = 5) in vec4 band;    // alpha: its share of the height
uniform float isSheet;                // 1: its triangles are seen from both sides
out float height;
out float lit;
flat out vec4 tint;
flat out vec4 upper;
// Nothing is as black as a colour's name.
vec4 shown(vec4 named) { return vec4((0.09 + 0.91 * named.rgb) * lightColour, named.a); }
void main() {
  mat2 turned = mat2(matrix.x, matrix.z, matrix.y, matrix.w);
  float tall = stands.w - stands.z;
  vec3 at = vec3(turned * place.xy + stands.xy, stands.z + place.z * tall);
  float area = matrix.x * matrix.w - matrix.y * matrix.z;
  mat2 across = mat2(matrix.w, -matrix.y, -matrix.z, matrix.x) / area;
  vec3 n = normalize(vec3(across * normal.xy, normal.z / tall));
  n *= isSheet * sign(-dot(n, at)) + 1.0 - isSheet;
  lit = ambient + (1.0 - ambient) * max(dot(n, light), 0.0);
  height = place.z;
  tint = shown(paint);
  upper = shown(band);
  gl_Position = toClip * vec4(at, 1.0);
}
)glsl";

const char* const kSolidFragment = R"glsl(
in float height;
in float lit;
flat in vec4 tint;
flat in vec4 upper;
layout(location = 0) out vec4 colour;
void main() {
  vec3 base = upper.a > 0.0 && height > 1.0 - upper.a ? upper.rgb : tint.rgb;
  colour = vec4(base * lit, tint.a);
}
)glsl";

}  // namespace ortung::shaders
