// Both look up beside the surface, so that it does not shade itself.
float CalcKeyVisibility(vec3 n) {
  const float kRadius = 0.0015;
  vec4 p = vec4(p_S + 1.5 * kRadius * n + 0.5 * kRadius * to_key, 1.0);
  return CalcVisibility(key_map, (key_from_S * p).xyz, key_extent.xy, kRadius, kTaps, 0.0);
}
float CalcSkyVisibility(vec3 n) {
  const float kSkyRadius = 0.012;
  vec4 p = vec4(p_S + 1.4 * kSkyRadius * n + vec3(0.0, 0.0, 0.5 * kSkyRadius), 1.0);
  return CalcVisibility(sky_map, (sky_from_S * p).xyz, sky_extent.xy, kSkyRadius, kTaps, 0.0);
}
