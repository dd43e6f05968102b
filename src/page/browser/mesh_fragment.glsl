flat in vec4 faceColour;
#ifdef SMOOTH
in vec3 eyeNormal;
#endif
#ifdef CUT
in float height;
#endif
out vec4 pixel;
void main() {
#ifdef CUT
  if (height < 0.0 || faceColour.a == 0.0) discard;
#endif
#ifdef SMOOTH
  pixel = vec4(faceColour.rgb * brightness(eyeNormal), faceColour.a);
#else
  pixel = faceColour;
#endif
}
