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
