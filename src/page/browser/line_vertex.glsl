layout(location = 0) in vec3 position;
uniform mat4 toClip;
uniform vec4 plane;
uniform float lift;
out float height;
void main() {
  gl_Position = toClip * vec4(position, 1.0);
  gl_Position.z -= lift;
  height = dot(plane.xyz, position) + plane.w;
}
