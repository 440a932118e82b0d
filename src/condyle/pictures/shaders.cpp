#include "condyle/pictures/shaders.h"

namespace condyle::shaders {

const char* const kMeshVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 X_VM;
uniform vec3 scale;
uniform vec3 shift;
uniform float push;      // mm away from the viewer
invariant gl_Position;
out vec3 n_V;
out float height;
out vec4 paint;
void main() {
  vec3 p = (X_VM * vec4(position, 1.0)).xyz;
  p.z -= push;
  n_V = mat3(X_VM) * normal;
  height = p.z;
  paint = vec4(pow(color.rgb, vec3(2.2)), color.a);
  gl_Position = vec4(p * scale + shift, 1.0);
})";

const char* const kPageVertex = R"(#version 330 core
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
})";

const char* const kGeometryFragment = R"(#version 330 core
in vec3 n_V;
in float height;
in vec4 paint;
out vec4 geometry;
void main() {
  vec3 n = normalize(n_V);
  geometry = vec4(gl_FrontFacing ? n : -n, height);
})";

const char* const kDepthFragment = R"(#version 330 core
void main() {}
)";

// Occlusion by samples on a spiral about the pixel, each weighed by how steeply it rises over the
// tangent plane and by how near it is. The spiral is turned and shrunk differently in each pixel of
// a 4 x 4 cell.
const char* const kOcclusionFragment = R"(#version 330 core
uniform sampler2D geometry;
uniform float mm_per_pixel;
uniform float reach;     // mm
out vec2 light;          // and the height, for smoothing
const int kSamples = 10;
const vec2 kSpiral[kSamples] = vec2[](
  vec2(0.100, 0.000), vec2(-0.145, 0.135), vec2(0.026, -0.299), vec2(0.243, 0.318), vec2(-0.492, -0.087),
  vec2(0.505, -0.321), vec2(-0.184, 0.676), vec2(-0.346, -0.720), vec2(0.786, 0.428), vec2(-0.940, 0.287));
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 g = texelFetch(geometry, here, 0);
  light = vec2(1.0, g.w);
  if (g.w < -9000.0) return;
  ivec2 last = textureSize(geometry, 0) - 1;
  int cell = (here.x & 3) + 4 * (here.y & 3);
  float angle = 6.2831853 * float((cell * 7) & 15) / 16.0;
  float size = (0.75 + 0.25 * float((cell * 11) & 15) / 15.0) * reach / mm_per_pixel;
  vec2 x = size * vec2(cos(angle), sin(angle)), y = vec2(-x.y, x.x);
  float blocked = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    ivec2 there = clamp(here + ivec2(round(kSpiral[i].x * x + kSpiral[i].y * y)), ivec2(0), last);
    vec3 d = vec3(vec2(there - here) * mm_per_pixel, texelFetch(geometry, there, 0).w - g.w);
    float rise = dot(d, g.xyz) - 0.02 * reach;
    float square = dot(d, d);
    float near = max(0.0, 1.0 - square / (reach * reach));
    blocked += near * max(0.0, rise) * inversesqrt(square + 0.01);
  }
  light.x = clamp(1.0 - 2.3 * blocked / float(kSamples), 0.0, 1.0);
})";

const char* const kSmoothFragment = R"(#version 330 core
uniform sampler2D noisy;
uniform float mm_per_pixel;
out float light;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  float height = texelFetch(noisy, here, 0).g;
  light = 1.0;
  if (height < -9000.0) return;
  ivec2 last = textureSize(noisy, 0) - 1;
  float scale = 1.0 / (16.0 * mm_per_pixel * mm_per_pixel);
  float sum = 0.0, weights = 0.0;
  for (int j = -2; j < 2; ++j) {
    for (int i = -2; i < 2; ++i) {
      vec2 sample_there = texelFetch(noisy, clamp(here + ivec2(i, j), ivec2(0), last), 0).rg;
      float step = sample_there.g - height;
      float weight = 1.0 / (1.0 + step * step * scale);
      sum += weight * sample_there.r;
      weights += weight;
    }
  }
  light = sum / weights;
})";

const char* const kShadeFragment = R"(#version 330 core
in vec3 n_V;
in float height;
in vec4 paint;
uniform sampler2D occlusion;
uniform vec2 page;       // size of the picture in pixels
uniform float gloss;
uniform vec4 paper;      // left, bottom, right, top beyond which there is nothing but paper, pixels
uniform float fade;      // width of the band inside in which everything turns to paper, pixels
out vec4 color;
const vec3 kKey = vec3(-0.48, 0.62, 0.62);
const vec3 kFill = vec3(0.77, 0.10, 0.63);
const vec3 kRim = vec3(0.25, 0.55, -0.80);
const vec3 kPower = vec3(0.9483, 0.0986, -0.0469);
void main() {
  vec3 n = normalize(gl_FrontFacing ? n_V : -n_V);
  float open = texture(occlusion, gl_FragCoord.xy / page).r;
  float facing = clamp(n.z, 0.0, 1.0);
  float key = max(0.0, dot(n, kKey));
  float fill = max(0.0, dot(n, kFill));
  float rim = max(0.0, dot(n, kRim));
  vec3 around = mix(vec3(0.34, 0.32, 0.31), vec3(0.56, 0.58, 0.62), 0.5 + 0.5 * n.y) * open;
  vec3 light = around + vec3(0.62, 0.60, 0.565) * key * mix(0.55, 1.0, open) + vec3(0.13, 0.14, 0.17) * fill * open;
  vec3 lit = paint.rgb * light + 0.18 * rim * open;
  vec3 half_way = normalize(kKey + vec3(0.0, 0.0, 1.0));
  float shine = max(0.0, dot(n, half_way));
  shine *= shine;        // to the power of 40, by squares
  shine *= shine;
  shine *= shine;
  float fourth = shine * shine;
  lit += gloss * fourth * fourth * shine * open;
  // A darker edge sets pale bone off from the white page.
  lit *= mix(0.62, 1.0, smoothstep(0.0, 0.45, facing));
  vec2 inward = min(gl_FragCoord.xy - paper.xy, paper.zw - gl_FragCoord.xy);
  float ink = smoothstep(0.0, 1.0, min(inward.x, inward.y) / fade);
  // x to the power of 1/2.2 within 0.004, by square roots: several times cheaper than pow.
  vec3 half_power = sqrt(clamp(lit, vec3(0.0), vec3(1.0)));
  vec3 quarter = sqrt(half_power);
  vec3 encoded = half_power * kPower.x + quarter * kPower.y + half_power * half_power * kPower.z;
  color = vec4(mix(vec3(1.0), encoded, ink), paint.a);
})";

}  // namespace condyle::shaders
