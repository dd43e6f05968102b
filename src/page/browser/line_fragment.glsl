in float height;
uniform vec4 lineColour;
out vec4 pixel;
void main() {
  if (height < 0.0) discard;
  pixel = lineColour;
}
