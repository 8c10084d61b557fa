in vec3 n_S;
uniform vec3 p_SEye;
uniform vec3 to_fill;
uniform vec3 to_rim;
uniform vec3 albedo;
uniform vec3 background_srgb;
uniform vec3 picture_size;
uniform float fade_share;
uniform float shade;  // 0: no shadow falls on it
out vec4 srgb;
void main() {
  vec3 n = normalize(n_S);
  if (!gl_FrontFacing) n = -n;
  vec3 to_eye = normalize(p_SEye - p_S);

  float key = max(dot(n, to_key), 0.0);
  if (key > 0.0) key *= mix(1.0, CalcKeyVisibility(n), shade);
  float sky = mix(1.0, CalcSkyVisibility(n), shade);

  float up = 0.5 + 0.5 * n.z;
  vec3 light = mix(vec3(0.13, 0.125, 0.12), vec3(0.27, 0.29, 0.32) * mix(0.3, 1.0, sky), up);
  light += vec3(1.00, 0.97, 0.92) * key;
  light += vec3(0.13, 0.15, 0.18) * max(dot(n, to_fill), 0.0);

  float away = 1.0 - max(dot(n, to_eye), 0.0);
  float edge = away * away * away;
  float gloss = max(dot(n, normalize(to_key + to_eye)), 0.0);
  for (int i = 0; i < 4; ++i) gloss *= gloss;
  gloss *= gloss * gloss;  // to the power of 48
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
