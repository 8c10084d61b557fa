// What a light map says without any shadow.
float CalcKeyVisibility(vec3 n) { return 1.0; }
float CalcSkyVisibility(vec3 n) { return 1.0; }
