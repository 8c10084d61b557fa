// One sample a pixel has steps at edges. Where the corners of a pixel differ, their gradient says how
// the edge runs, and the mean along it smooths the steps (after Lottes, "FXAA", 2009).
in vec2 uv;
uniform sampler2D rough;
out vec4 srgb;

float CalcBrightness(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
vec3 TakeBoth(vec2 offset) {
  return 0.5 * (texture(rough, uv - offset).rgb + texture(rough, uv + offset).rgb);
}

void main() {
  vec2 texel = 1.0 / vec2(textureSize(rough, 0));
  vec3 upper_left = texture(rough, uv + texel * vec2(-0.5, 0.5)).rgb;
  vec3 upper_right = texture(rough, uv + texel * vec2(0.5, 0.5)).rgb;
  vec3 lower_left = texture(rough, uv + texel * vec2(-0.5, -0.5)).rgb;
  vec3 lower_right = texture(rough, uv + texel * vec2(0.5, -0.5)).rgb;
  vec3 middle = texture(rough, uv).rgb;
  vec4 corners = vec4(CalcBrightness(upper_left), CalcBrightness(upper_right),
                      CalcBrightness(lower_left), CalcBrightness(lower_right));
  float lowest = min(min(corners.x, corners.y), min(corners.z, corners.w));
  float highest = max(max(corners.x, corners.y), max(corners.z, corners.w));
  if (highest - lowest > 0.04) {
    vec2 along = vec2(corners.x + corners.y - corners.z - corners.w,
                      corners.x + corners.z - corners.y - corners.w);
    const float kMaxLength = 4.0;  // [pixel]
    along /= min(abs(along.x), abs(along.y)) + 0.02;
    along = clamp(along, -kMaxLength, kMaxLength) * texel;
    vec3 near = TakeBoth(along / 6.0);
    vec3 far = 0.5 * (near + TakeBoth(0.5 * along));
    // What is brighter or darker than the pixel's corners lies beyond the edge.
    float brightness = CalcBrightness(far);
    middle = brightness < lowest || brightness > highest ? near : far;
  }
  vec3 mean = 0.25 * (upper_left + upper_right + lower_left + lower_right);
  srgb = vec4(mix(middle, mean, 0.25), 1.0);
}
