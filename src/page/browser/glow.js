// What is seen of highlighted faces through the grey rest: a tint where they are hidden, and a halo around them. The
// faces are drawn into a mask, which is blurred twice, along x and along y.

const kMaskShare = 0.5, kHaloShare = 0.25;  // Sizes of the textures, relative to the frame.
const kHiddenOpacity = 0.45, kHaloOpacity = 0.5;

export class Glow {
  constructor(renderer) {
    this.renderer = renderer;
    this.textures = null;
    this.corners = renderer.gl.createVertexArray();  // No attributes: the vertex shader computes the corners.
  }

  /** A texture of a share of the frame, with its framebuffer. */
  texture(share, width, height) {
    const { gl } = this.renderer, size = [width, height].map((side) => Math.max(Math.round(side * share), 1));
    const texture = gl.createTexture(), framebuffer = gl.createFramebuffer();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, ...size);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return { texture, framebuffer, size, share };
  }

  resize(width, height) {
    if (this.width === width && this.height === height) return;
    const { gl } = this.renderer;
    for (const { texture, framebuffer } of this.textures ?? []) {
      gl.deleteTexture(texture);
      gl.deleteFramebuffer(framebuffer);
    }
    Object.assign(this, { width, height });
    this.textures = [kMaskShare, kHaloShare, kHaloShare].map((share) => this.texture(share, width, height));
  }

  /** Draws the mask of the highlighted faces of the panes, and blurs it. */
  prepare(frame, panes) {
    const { gl } = this.renderer;
    this.resize(frame.width, frame.height);
    const [mask, along, halo] = this.textures;
    this.begin(mask);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ZERO, gl.ONE, gl.ZERO);  // Multiplies the colours by alpha.
    gl.enable(gl.SCISSOR_TEST);
    for (const pane of panes) {
      const area = pane.viewport.map((value) => Math.round(value * mask.share));
      gl.viewport(...area);
      gl.scissor(...area);
      // An inset covers the pane below it.
      gl.clear(gl.COLOR_BUFFER_BIT);
      this.renderer.drawFaces(pane.highlighted, pane, { ...frame, shading: 'plain', back: 'same' });
    }
    gl.disable(gl.BLEND);
    gl.disable(gl.SCISSOR_TEST);
    if (frame.glows) {
      const step = frame.scale * kHaloShare;
      this.blur(mask, along, [step / along.size[0], 0]);
      this.blur(along, halo, [0, step / halo.size[1]]);
    }
    gl.enable(gl.DEPTH_TEST);
  }

  begin({ framebuffer, size }) {
    const { gl } = this.renderer;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.viewport(0, 0, ...size);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  use(name, ...textures) {
    const { gl } = this.renderer, program = this.renderer.program(name, [], 'screen');
    gl.useProgram(program.program);
    textures.forEach(([uniform, { texture }], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(program.uniforms[uniform], unit);
    });
    return program.uniforms;
  }

  fill() {
    const { gl } = this.renderer;
    gl.disable(gl.CULL_FACE);
    gl.bindVertexArray(this.corners);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  blur(from, to, step) {
    this.begin(to);
    const uniforms = this.use('blur', ['source', from]);
    this.renderer.gl.uniform2fv(uniforms.stride, step);
    this.renderer.gl.uniform2fv(uniforms.size, to.size);
    this.fill();
  }

  /** Blends the mask and its halo over the current viewport. */
  draw(frame) {
    const { gl } = this.renderer, [mask, , halo] = this.textures;
    const uniforms = this.use('glow', ['mask', mask], ['halo', halo]);
    gl.uniform2fv(uniforms.size, [frame.width, frame.height]);
    gl.uniform2fv(uniforms.opacities, [kHiddenOpacity, frame.glows ? kHaloOpacity : 0]);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    this.fill();
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
  }
}
