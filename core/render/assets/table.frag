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
