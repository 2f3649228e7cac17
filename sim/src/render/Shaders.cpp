#include "Shaders.hpp"

namespace ortung::shaders {

// Positions are relative to the camera, with the field's axes, so single precision is enough
// everywhere.
const char* const kHead = R"glsl(
uniform mat4 toClip;
uniform vec3 light;       // towards it
uniform float ambient;
uniform vec3 lightColour;
)glsl";

const char* const kFloorVertex = R"glsl(
layout(location = 0) in vec3 place;  // x, y, whether it is the field
uniform vec3 origin;                 // of the scene's middle from the camera
out vec3 at;
flat out float isField;
void main() {
  at = vec3(place.xy, 0.0) + origin;
  isField = place.z;
  gl_Position = toClip * vec4(at, 1.0);
}
)glsl";

const char* const kFloorFragment = R"glsl(
in vec3 at;
flat in float isField;
#ifdef ANNOTATE
layout(location = 0) out vec4 thing;
layout(location = 1) out float range;
void main() {
  thing = vec4(isField / 255.0, 0.0, 0.0, 0.0);
  range = length(at);
}
#else
layout(location = 0) out vec4 colour;
uniform vec3 turf;
uniform vec3 ground;
float shade(vec2 p);
uniform vec3 camera;
void main() {
  vec3 base = isField > 0.5 ? turf : ground;
#ifdef VARIED
  base *= shade(at.xy + camera.xy);
#endif
  colour = vec4(base * lightColour, 1.0);
}
#ifdef VARIED
uniform float grain;
uniform float patches;
uniform vec4 stripes;  // how strong, width, cosine and sine of across
uniform uint seed;
float number(ivec2 cell, uint salt) {
  uint h = uint(cell.x) * 0x9E3779B1u ^ uint(cell.y) * 0x85EBCA77u ^ (seed + salt) * 0xC2B2AE3Du;
  h ^= h >> 15; h *= 0x2C1B3C6Du; h ^= h >> 12; h *= 0x297A2D39u; h ^= h >> 15;
  return float(h & 0xFFFFu) / 65535.0 - 0.5;
}
float noise(vec2 p, uint salt) {
  vec2 f = floor(p);
  vec2 t = p - f;
  t = t * t * (3.0 - 2.0 * t);
  ivec2 c = ivec2(f);
  float low = mix(number(c, salt), number(c + ivec2(1, 0), salt), t.x);
  float high = mix(number(c + ivec2(0, 1), salt), number(c + ivec2(1, 1), salt), t.x);
  return mix(low, high, t.y);
}
// What is finer than a pixel fades.
float shade(vec2 p) {
  float size = length(vec2(length(dFdx(p)), length(dFdy(p))));
  float fine = clamp(1.5 - size / 0.02, 0.0, 1.0);
  float middle = clamp(1.5 - size / 0.15, 0.0, 1.0);
  float far = noise(p / 3.0, 3u) + 0.5 * noise(p / 0.9, 2u);
  float across = (p.x * stripes.z + p.y * stripes.w) / stripes.y;
  float stripe = abs(fract(0.5 * across) - 0.5) > 0.25 ? 1.0 : -1.0;
  float near = middle * noise(p / 0.12, 1u) + fine * noise(p / 0.012, 0u);
  return max(1.0 + grain * near + patches * far + stripes.x * stripe, 0.05);
}
#endif
#endif
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
out vec3 at;
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
  at = p;
  tint = paint.rgb;
  gl_Position = toClip * vec4(p, 1.0);
}
)glsl";

// How much of a pixel the line covers: a pixel is a box across the edge.
const char* const kLineFragment = R"glsl(
in vec4 inLine;
in vec3 at;
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
#ifdef ANNOTATE
layout(location = 0) out vec4 thing;
layout(location = 1) out float range;
void main() {
  if (covered() < 0.5) discard;
  thing = vec4(2.0 / 255.0, 0.0, 0.0, 0.0);
  range = length(at);
}
#else
layout(location = 0) out vec4 colour;
void main() { colour = vec4(tint * lightColour, covered()); }
#endif
)glsl";

const char* const kSolidVertex = R"glsl(
layout(location = 0) in vec3 place;   // of the unit shape
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 matrix;  // row by row
layout(location = 3) in vec4 stands;  // x, y, low and high z, from the camera
layout(location = 4) in vec4 paint;
layout(location = 5) in vec4 band;    // alpha: its share of the height
layout(location = 6) in vec4 what;
out vec3 at;
out vec3 facing;
out float height;
flat out vec4 tint;
flat out vec4 upper;
flat out vec4 thingIs;
void main() {
  mat2 turned = mat2(matrix.x, matrix.z, matrix.y, matrix.w);
  float tall = stands.w - stands.z;
  at = vec3(turned * place.xy + stands.xy, stands.z + place.z * tall);
  float area = matrix.x * matrix.w - matrix.y * matrix.z;
  mat2 across = mat2(matrix.w, -matrix.y, -matrix.z, matrix.x) / area;
  facing = vec3(across * normal.xy, normal.z / tall);
  height = place.z;
  tint = paint;
  upper = band;
  thingIs = what;
  gl_Position = toClip * vec4(at, 1.0);
}
)glsl";

const char* const kSolidFragment = R"glsl(
in vec3 at;
in vec3 facing;
in float height;
flat in vec4 tint;
flat in vec4 upper;
flat in vec4 thingIs;
#ifdef ANNOTATE
layout(location = 0) out vec4 thing;
layout(location = 1) out float range;
void main() {
  thing = thingIs;
  range = length(at);
}
#else
layout(location = 0) out vec4 colour;
void main() {
  vec3 n = normalize(facing);
  n *= sign(-dot(n, at));  // sheets are seen from both sides
  float lit = ambient + (1.0 - ambient) * max(dot(n, light), 0.0);
  // Nothing is as black as a colour's name.
  vec3 base = 0.09 + 0.91 * (upper.a > 0.0 && height > 1.0 - upper.a ? upper.rgb : tint.rgb);
  colour = vec4(base * lightColour * lit, tint.a);
}
#endif
)glsl";

}  // namespace ortung::shaders
