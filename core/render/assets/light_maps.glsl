// What a light map tells about a point. A map's coordinates run from 0 to 1 over `extent` metres,
// depth last. `taps` points on a sunflower disc cover the filter evenly.
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
