layout(location = 0) in vec3 position;
uniform mat4 toClip;
uniform vec4 plane;
out float height;
void main() {
  gl_Position = toClip * vec4(position, 1.0);
  height = dot(plane.xyz, position) + plane.w;
}
