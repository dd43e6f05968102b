// The colours of both textures are multiplied by alpha.
uniform sampler2D mask;
uniform sampler2D halo;
uniform vec2 size;
uniform vec2 opacities;
out vec4 pixel;
void main() {
  vec2 place = gl_FragCoord.xy / size;
  vec4 covered = texture(mask, place), around = texture(halo, place);
  float light = 1.0 - pow(1.0 - around.a, 5.0);  // A place of a few pixels has a visible halo.
  float alpha = mix(opacities.y * light, opacities.x, covered.a);
  vec4 source = covered.a > 0.01 ? covered : around;
  pixel = vec4(source.rgb / max(source.a, 1e-3), alpha);
}
