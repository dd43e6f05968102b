layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec3 smoothNormal;
uniform mat4 toClip;
uniform mat3 toEye;
uniform vec4 plane;
uniform vec4 backColour;
uniform float plainness;
uniform vec4 restColour;
flat out vec4 faceColour;
#ifdef SMOOTH
out vec3 eyeNormal;
#endif
#ifdef CUT
out float height;
#endif
void main() {
  gl_Position = toClip * vec4(position, 1.0);
  vec3 faceNormal = toEye * normal;
#ifdef REST
  vec4 own = restColour;
#else
  vec4 own = colour;
#endif
  faceColour = vec4(faceNormal.z < 0.0 ? mix(own.rgb, backColour.rgb, backColour.a) : own.rgb, own.a);
#ifdef SMOOTH
  eyeNormal = toEye * smoothNormal;
#else
  faceColour.rgb *= mix(brightness(faceNormal), 1.0, plainness);
#endif
#ifdef CUT
  height = dot(plane.xyz, position) + plane.w;
#endif
}
