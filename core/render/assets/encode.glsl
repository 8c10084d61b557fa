// Colours are clipped and encoded before edges are smoothed: so edges of dark
// things on the bright table get even steps, and no highlight eats the edge beside it. Roots stand
// for the power of 1 / 2.4, within 0.002 (I. Taylor, "sRGB approximations for HLSL", 2012).
vec4 EncodeSrgb(vec3 radiance) {
  vec3 c = min(radiance, vec3(1.0));
  vec3 r2 = sqrt(c), r4 = sqrt(r2), r8 = sqrt(r4);
  return vec4(0.662002687 * r2 + 0.684122060 * r4 - 0.323583601 * r8 - 0.0225411470 * c, 1.0);
}
