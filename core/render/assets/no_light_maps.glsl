// What CalcVisibility says without any map.
float CalcKeyVisibility(vec3 n, float turn) { return 1.0; }
float CalcSkyVisibility(vec3 n, float turn) { return 1.0; }
