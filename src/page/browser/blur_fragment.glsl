// Gaussian weights with a standard deviation of three steps.
uniform sampler2D source;
uniform vec2 stride;
uniform vec2 size;
out vec4 pixel;
void main() {
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = -7; i <= 7; ++i) {
    float weight = exp(float(-i * i) / 18.0);
    sum += weight * texture(source, gl_FragCoord.xy / size + float(i) * stride);
    total += weight;
  }
  pixel = sum / total;
}
