flat in vec4 faceColour;
#ifdef CUT
in float height;
#endif
out vec4 pixel;
void main() {
#ifdef CUT
  if (height < 0.0 || faceColour.a == 0.0) discard;
#endif
  pixel = faceColour;
}
