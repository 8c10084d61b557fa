#include "core/render/shaders.h"

namespace graspbench {
namespace {

const char kVersion[] = "#version 330 core\n";

// A triangle that covers the whole picture; uv runs from 0 to 1 over it.
const char kWholePictureVertex[] = R"(
out vec2 uv;
void main() {
  uv = vec2((gl_VertexID & 1) << 1, gl_VertexID & 2);
  gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
)";

const char kPositionVertex[] = R"(
layout(location = 0) in vec3 p_M;
uniform mat4 clip_from_M;
void main() { gl_Position = clip_from_M * vec4(p_M, 1.0); }
)";

const char kTableVertex[] = R"(
uniform mat4 clip_from_S;
out vec2 p_S;
void main() {
  p_S = 20.0 * (vec2(gl_VertexID & 1, gl_VertexID >> 1) - 0.5);  // a square of 20 m
  gl_Position = clip_from_S * vec4(p_S, 0.0, 1.0);
}
)";

const char kGeometryFragment[] = R"(
uniform float id;
out vec2 id_and_depth;
void main() { id_and_depth = vec2(id, 1.0 / gl_FragCoord.w); }
)";

// Colours are clipped and encoded before the mean of a pixel's samples is taken: so edges of dark
// things on the bright table get even steps, and no highlight eats the edge beside it.
const char kEncode[] = R"(
vec4 EncodeSrgb(vec3 radiance) {
  vec3 c = min(radiance, vec3(1.0));
  return vec4(mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}
)";

// What a light map tells about a point. A map's coordinates run from 0 to 1 over `extent` metres,
// depth last. `taps` points on a sunflower disc cover the filter evenly.
const char kLightMaps[] = R"(
uniform sampler2DShadow key_map;
uniform sampler2D key_depth;
uniform mat4 key_from_S;
uniform vec3 key_extent;
uniform sampler2DShadow sky_map;
uniform sampler2D sky_depth;
uniform mat4 sky_from_S;
uniform vec3 sky_extent;

vec2 SunflowerPoint(int i, int taps, float turn) {
  float angle = 2.399963 * float(i) + turn;
  return sqrt((float(i) + 0.5) / float(taps)) * vec2(cos(angle), sin(angle));
}

// Share of a disc of `radius` metres around the point that the light reaches.
float CalcVisibility(sampler2DShadow map, vec3 p, vec2 extent, float radius, int taps,
                     float turn) {
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) {
    sum += texture(map, vec3(p.xy + radius * SunflowerPoint(i, taps, turn) / extent, p.z));
  }
  return sum / float(taps);
}

// The same for a light of angular size `spread` (tangent): the disc grows with the distance to
// whatever is in the way (percentage-closer soft shadows, Fernando 2005).
float CalcSoftVisibility(sampler2DShadow map, sampler2D depth, vec3 p, vec3 extent, float spread,
                         float search_radius, int taps, float turn) {
  float blocker_sum = 0.0;
  float num_blockers = 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 offset = search_radius * SunflowerPoint(i, taps, turn);
    float blocker = texture(depth, p.xy + offset / extent.xy).r;
    if (blocker < min(p.z, 1.0)) {
      blocker_sum += blocker;
      num_blockers += 1.0;
    }
  }
  if (num_blockers == 0.0) return 1.0;
  float gap = (p.z - blocker_sum / num_blockers) * extent.z;
  float radius = clamp(gap * spread, 0.0015, search_radius);
  return CalcVisibility(map, p, extent.xy, radius, taps, turn);
}
)";

// What CalcVisibility says without any map.
const char kNoLightMaps[] = R"(
float CalcKeyVisibility(vec3 n, float turn) { return 1.0; }
float CalcSkyVisibility(vec3 n, float turn) { return 1.0; }
)";

// Both look up beside the surface, so that it does not shade itself.
const char kSurfaceLightMaps[] = R"(
float CalcKeyVisibility(vec3 n, float turn) {
  const float kRadius = 0.0015;
  vec4 p = vec4(p_S + 1.5 * kRadius * n + 0.5 * kRadius * to_key, 1.0);
  return CalcVisibility(key_map, (key_from_S * p).xyz, key_extent.xy, kRadius, kTaps, turn);
}
float CalcSkyVisibility(vec3 n, float turn) {
  const float kSkyRadius = 0.012;
  vec4 p = vec4(p_S + 1.4 * kSkyRadius * n + vec3(0.0, 0.0, 0.5 * kSkyRadius), 1.0);
  return CalcVisibility(sky_map, (sky_from_S * p).xyz, sky_extent.xy, kSkyRadius, kTaps, turn);
}
)";

std::string FormatTaps(int taps) { return "const int kTaps = " + std::to_string(taps) + ";\n"; }

}  // namespace

ShaderSource MakeDepthShader() {
  return {"depth", std::string(kVersion) + kPositionVertex,
          std::string(kVersion) + "void main() {}\n"};
}

ShaderSource MakeTableLightShader(int taps) {
  return {"table light", std::string(kVersion) + kWholePictureVertex,
          std::string(kVersion) + FormatTaps(taps) + kLightMaps + R"(
in vec2 uv;
uniform vec4 table_area;  // x, y of its corner, length, width in S [m]
out vec2 visibility;      // of the key light and of the sky
void main() {
  vec4 p_S = vec4(table_area.xy + uv * table_area.zw, 0.0, 1.0);
  // Each of 4 x 4 neighbours turns its disc of taps by another sixteenth; the smoothing pass takes
  // their mean, so the penumbra has sixteen times as many taps and no pattern.
  ivec2 texel = ivec2(gl_FragCoord.xy) & 3;
  float turn = 2.399963 * 2.6180340 * float(texel.x + 4 * texel.y);
  visibility.x = CalcSoftVisibility(key_map, key_depth, (key_from_S * p_S).xyz, key_extent, 0.13,
                                    0.03, kTaps, turn);
  visibility.y = CalcSoftVisibility(sky_map, sky_depth, (sky_from_S * p_S).xyz, sky_extent, 0.8,
                                    0.06, kTaps, turn);
}
)"};
}

ShaderSource MakeSmoothShader() {
  return {"smooth", std::string(kVersion) + kWholePictureVertex, std::string(kVersion) + R"(
in vec2 uv;
uniform sampler2D rough;
out vec2 smooth_value;
void main() {
  vec2 texel = 1.0 / vec2(textureSize(rough, 0));
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 4; ++i) {  // each tap is the mean of 2 x 2 texels
    sum += texture(rough, uv + texel * (2.0 * vec2(i & 1, i >> 1) - 0.5)).rg;
  }
  smooth_value = 0.25 * sum;
}
)"};
}

ShaderSource MakeSurfaceShader(int taps) {
  return {"surface", std::string(kVersion) + R"(
layout(location = 0) in vec3 p_M;
layout(location = 1) in vec3 n_M;
uniform mat4 S_from_M;
uniform mat4 clip_from_S;
out vec3 p_S;
out vec3 n_S;
void main() {
  vec4 p = S_from_M * vec4(p_M, 1.0);
  p_S = p.xyz;
  n_S = mat3(S_from_M) * n_M;
  gl_Position = clip_from_S * p;
}
)",
          std::string(kVersion) + "in vec3 p_S;\nuniform vec3 to_key;\n" + kEncode +
              (taps > 0 ? FormatTaps(taps) + kLightMaps + kSurfaceLightMaps : kNoLightMaps) + R"(
in vec3 n_S;
uniform vec3 p_SEye;
uniform vec3 to_fill;
uniform vec3 to_rim;
uniform vec3 albedo;
uniform vec3 background_srgb;
uniform vec3 picture_size;
uniform float fade_share;
out vec4 srgb;
void main() {
  vec3 n = normalize(n_S);
  if (!gl_FrontFacing) n = -n;
  vec3 to_eye = normalize(p_SEye - p_S);

  // The four samples of a pixel turn their discs of taps differently.
  float turn = 0.6 * float((int(gl_FragCoord.x) & 1) + 2 * (int(gl_FragCoord.y) & 1));
  float key = max(dot(n, to_key), 0.0);
  if (key > 0.0) key *= CalcKeyVisibility(n, turn);
  float sky = CalcSkyVisibility(n, turn);

  float up = 0.5 + 0.5 * n.z;
  vec3 light = mix(vec3(0.13, 0.125, 0.12), vec3(0.27, 0.29, 0.32) * mix(0.3, 1.0, sky), up);
  light += vec3(1.00, 0.97, 0.92) * key;
  light += vec3(0.13, 0.15, 0.18) * max(dot(n, to_fill), 0.0);

  float edge = pow(1.0 - max(dot(n, to_eye), 0.0), 3.0);
  float gloss = pow(max(dot(n, normalize(to_key + to_eye)), 0.0), 48.0);
  vec3 shine = vec3(0.16) * gloss * step(1e-3, key) * min(4.0 * key, 1.0);
  shine += vec3(0.22, 0.24, 0.27) * edge * max(dot(n, to_rim), 0.0);
  // Above the knee brightness is compressed, so that white things keep their shape.
  vec3 radiance = albedo * light + shine;
  const float kKnee = 0.5;
  vec3 excess = max(radiance - kKnee, 0.0) / (1.0 - kKnee);
  srgb = EncodeSrgb(min(radiance, kKnee) + (1.0 - kKnee) * (1.0 - exp(-excess)));
  if (fade_share > 0.0) {
    vec2 share = gl_FragCoord.xy / picture_size.xy;
    vec2 inside = min(share, 1.0 - share);
    float shown = smoothstep(0.0, fade_share, min(inside.x, inside.y));
    srgb.rgb = mix(background_srgb, srgb.rgb, shown);
  }
}
)"};
}

ShaderSource MakeTableShader() {
  return {"table", std::string(kVersion) + kTableVertex, std::string(kVersion) + kEncode + R"(
in vec2 p_S;
uniform vec4 world_from_S;  // cosine and sine of the heading, x, y of S in W
uniform sampler2D table_light;
uniform vec4 table_area;
uniform vec3 background;
uniform float grid;  // share of the light that its lines take
uniform float fade_radius;
out vec4 srgb;
void main() {
  vec2 visibility = texture(table_light, (p_S - table_area.xy) / table_area.zw).rg;
  float light = mix(0.52, 1.0, visibility.x) * mix(0.55, 1.0, visibility.y);

  vec2 p_W = world_from_S.zw + mat2(world_from_S.x, world_from_S.y, -world_from_S.y,
                                    world_from_S.x) * p_S;
  const float kSpacing = 0.05;
  const float kHalfWidth = 0.0004;
  vec2 distance = abs(fract(p_W / kSpacing - 0.5) - 0.5) * kSpacing;
  vec2 pixel = max(fwidth(p_W), vec2(1e-6));
  vec2 cover = clamp((kHalfWidth - distance) / pixel + 0.5, 0.0, 1.0) *
               min(2.0 * kHalfWidth / pixel, 1.0);
  float line = max(cover.x, cover.y) *
               (1.0 - smoothstep(0.5 * fade_radius, fade_radius, length(p_S)));
  srgb = EncodeSrgb(background * light * (1.0 - grid * line));
}
)"};
}

ShaderSource MakeGeometryShader() {
  return {"geometry", std::string(kVersion) + kPositionVertex,
          std::string(kVersion) + kGeometryFragment};
}

ShaderSource MakeTableGeometryShader() {
  return {"table geometry", std::string(kVersion) + kTableVertex,
          std::string(kVersion) + kGeometryFragment};
}

ShaderSource MakeResolveShader() {
  return {"resolve", std::string(kVersion) + kWholePictureVertex, std::string(kVersion) + R"(
in vec2 uv;
uniform sampler2D fine;
out vec4 srgb;
void main() {
  // Weights 1 3 3 1 along each side, by four taps that lie between texels.
  vec2 offset = 0.75 / vec2(textureSize(fine, 0));
  srgb = 0.25 * (texture(fine, uv - offset) + texture(fine, uv + offset) +
                 texture(fine, uv + vec2(offset.x, -offset.y)) +
                 texture(fine, uv + vec2(-offset.x, offset.y)));
}
)"};
}

}  // namespace graspbench
