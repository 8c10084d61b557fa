// Colours are clipped and encoded before the mean of a pixel's samples is taken: so edges of dark
// things on the bright table get even steps, and no highlight eats the edge beside it.
vec4 EncodeSrgb(vec3 radiance) {
  vec3 c = min(radiance, vec3(1.0));
  return vec4(mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}
