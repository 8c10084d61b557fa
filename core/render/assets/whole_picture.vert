// A triangle that covers the whole picture; uv runs from 0 to 1 over it.
out vec2 uv;
void main() {
  uv = vec2((gl_VertexID & 1) << 1, gl_VertexID & 2);
  gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
