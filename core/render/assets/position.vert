layout(location = 0) in vec3 p_M;
uniform mat4 clip_from_M;
void main() { gl_Position = clip_from_M * vec4(p_M, 1.0); }
