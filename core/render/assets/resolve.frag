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
