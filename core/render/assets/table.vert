uniform mat4 clip_from_S;
out vec2 p_S;
void main() {
  p_S = 20.0 * (vec2(gl_VertexID & 1, gl_VertexID >> 1) - 0.5);  // a square of 20 m
  gl_Position = clip_from_S * vec4(p_S, 0.0, 1.0);
}
