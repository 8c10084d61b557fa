layout(location = 0) in vec3 p_M;
layout(location = 1) in vec3 n_M;
uniform mat4 S_from_M;
uniform mat4 clip_from_S;
out vec3 p_S;
out vec3 n_S;
void main() {
  vec4 p = S_from_M * vec4(p_M, 1.0);
  p_S = p.xyz;
  n_S = mat3(S_from_M) * n_M;
  gl_Position = clip_from_S * p;
}
