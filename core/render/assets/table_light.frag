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
