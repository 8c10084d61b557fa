// What a light map tells about a point of a surface. A map's coordinates run from 0 to 1 over
// `extent` metres, depth last.
uniform sampler2DShadow key_map;
uniform mat4 key_from_S;
uniform vec3 key_extent;
uniform sampler2DShadow sky_map;
uniform mat4 sky_from_S;
uniform vec3 sky_extent;

// Share of a disc of `radius` metres around the point that the light reaches, by points of a
// sunflower, which cover it evenly.
float CalcVisibility(sampler2DShadow map, vec3 p, vec2 extent, float radius) {
  float sum = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float angle = 2.399963 * float(i);
    vec2 tap = sqrt((float(i) + 0.5) / float(kTaps)) * vec2(cos(angle), sin(angle));
    sum += texture(map, vec3(p.xy + radius * tap / extent, p.z));
  }
  return sum / float(kTaps);
}

// Both look up beside the surface, so that it does not shade itself.
float CalcKeyVisibility(vec3 n) {
  const float kRadius = 0.0015;
  vec4 p = vec4(p_S + 1.5 * kRadius * n + 0.5 * kRadius * to_key, 1.0);
  return CalcVisibility(key_map, (key_from_S * p).xyz, key_extent.xy, kRadius);
}
float CalcSkyVisibility(vec3 n) {
  const float kSkyRadius = 0.012;
  vec4 p = vec4(p_S + 1.4 * kSkyRadius * n + vec3(0.0, 0.0, 0.5 * kSkyRadius), 1.0);
  return CalcVisibility(sky_map, (sky_from_S * p).xyz, sky_extent.xy, kSkyRadius);
}
