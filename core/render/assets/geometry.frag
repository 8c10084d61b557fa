uniform float id;
out vec2 id_and_depth;
void main() { id_and_depth = vec2(id, 1.0 / gl_FragCoord.w); }
