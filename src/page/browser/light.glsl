// Brightness of a surface, the same on both sides. The minimum is high enough to recognise the colours of the legend.
// normal: components along right, up and towards the viewer.
float brightness(vec3 normal) {
  vec3 n = normalize(normal + vec3(0.0, 0.0, 1e-6));
  if (n.z < 0.0) n = -n;
  return 0.58 + 0.3 * max(dot(n, vec3(-0.46, 0.62, 0.635)), 0.0) + 0.2 * n.z;
}
