// Draws with WebGL 2: meshes with flat colours, highlighted faces in a grey mesh, edges, outlines.
import { Glow } from './glow.js';

const kSampleCount = 4, kCoarseFaceCount = 20000;
const kRestGrey = [0.8, 0.81, 0.825];
const kCreaseCosine = 0.82;  // Cosine of the least angle between the normals of two faces at a crease, 35 degrees.
const kMostCreasedFaces = 400000;
const kPosition = 0, kColour = 1, kNormal = 2, kSmoothNormal = 3;

export class Renderer {
  /** Returns null without WebGL 2. */
  static create(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: false, alpha: false, powerPreference: 'high-performance' });
    return gl && new Renderer(gl);
  }

  constructor(gl) {
    this.gl = gl;
    this.restore();
  }

  /** Sets up the context at first use, and after a loss of the context. After a loss, meshes must be added again. */
  restore() {
    const { gl } = this;
    this.programs = new Map();
    this.target = null;
    this.glow = new Glow(this);
    const provoking = gl.getExtension('WEBGL_provoking_vertex');
    this.isFirstProvoking = Boolean(provoking);
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    this.isSoftware = Boolean(names) && /SwiftShader|llvmpipe|software|Basic Render/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
    if (provoking) provoking.provokingVertexWEBGL(provoking.FIRST_VERTEX_CONVENTION_WEBGL);
    this.outline = { vao: gl.createVertexArray(), buffer: gl.createBuffer() };
    gl.bindVertexArray(this.outline.vao);
    this.attribute(kPosition, this.outline.buffer, 3, gl.FLOAT, false);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
  }

  attribute(location, buffer, size, type, normalized) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, type, normalized, 0, 0);
  }

  addMesh(model) {
    const { gl } = this;
    const drawn = model.drawnVertices(this.isFirstProvoking);
    const mesh = { model, indexCount: drawn.triangles.length, sources: drawn.sources, vao: gl.createVertexArray(), buffers: [] };
    gl.bindVertexArray(mesh.vao);
    const filled = (target, data) => {
      const buffer = this.buffer(mesh);
      gl.bindBuffer(target, buffer);
      gl.bufferData(target, data, gl.STATIC_DRAW);
      return buffer;
    };
    mesh.positions = filled(gl.ARRAY_BUFFER, drawn.positions);
    this.attribute(kPosition, mesh.positions, 3, gl.FLOAT, false);
    // Only the first faceCount vertices have a colour and a normal, because other vertices are not provoking vertices.
    mesh.colours = filled(gl.ARRAY_BUFFER, 4 * drawn.sources.length);
    this.attribute(kColour, mesh.colours, 4, gl.UNSIGNED_BYTE, true);
    const normals = filled(gl.ARRAY_BUFFER, 4 * drawn.sources.length);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, model.normals);
    this.attribute(kNormal, normals, 4, gl.BYTE, true);
    filled(gl.ELEMENT_ARRAY_BUFFER, drawn.triangles);
    gl.bindVertexArray(null);
    return mesh;
  }

  /** A new buffer, which release() deletes with the mesh. */
  buffer(mesh) {
    mesh.buffers.push(this.gl.createBuffer());
    return mesh.buffers.at(-1);
  }

  release(mesh) {
    const { gl } = this;
    for (const buffer of mesh.buffers) gl.deleteBuffer(buffer);
    for (const part of [mesh, mesh.edges, mesh.creases]) if (part?.vao) gl.deleteVertexArray(part.vao);
    if (mesh.coarse) this.release(mesh.coarse);
  }

  setColours(mesh, colours) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.colours);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, new Uint8Array(colours.buffer));
    mesh.colouring = colours;
    mesh.hasRest = colours.some((colour) => colour >>> 24 === 0);
    mesh.isAllRest = mesh.hasRest && colours.every((colour) => colour >>> 24 === 0);
  }

  smooth(mesh) {
    if (mesh.isSmooth) return;
    const { gl } = this;
    const bytes = new Int32Array(mesh.model.smoothNormals().buffer);
    const buffer = this.buffer(mesh);
    gl.bindVertexArray(mesh.vao);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Int32Array.from(mesh.sources, (vertex) => bytes[vertex]), gl.STATIC_DRAW);
    this.attribute(kSmoothNormal, buffer, 4, gl.BYTE, true);
    mesh.isSmooth = true;
  }

  // A copy with few triangles. Slow devices draw this copy during motion of the view.
  coarse(mesh) {
    if (mesh.model.faceCount < 2 * kCoarseFaceCount) return mesh;
    mesh.coarse ??= this.addMesh(mesh.model.reduced(kCoarseFaceCount));
    const { coarse, colouring } = mesh;
    if (coarse.source !== colouring)
      this.setColours(coarse, Uint32Array.from(coarse.model.sourceFaces, (face) => colouring[face]));
    coarse.source = colouring;
    return coarse;
  }

  /** Lines between pairs of vertices of the mesh. */
  lines(mesh) {
    const { gl } = this, lines = { vao: gl.createVertexArray(), indices: this.buffer(mesh) };
    if (!mesh.corners) {
      mesh.corners = this.buffer(mesh);
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.corners);
      gl.bufferData(gl.ARRAY_BUFFER, mesh.model.positions, gl.STATIC_DRAW);
    }
    gl.bindVertexArray(lines.vao);
    this.attribute(kPosition, mesh.corners, 3, gl.FLOAT, false);
    return lines;
  }

  fillLines(lines, ends) {
    const { gl } = this;
    gl.bindVertexArray(lines.vao);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, lines.indices);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, ends, gl.STATIC_DRAW);
    lines.count = ends.length;
  }

  // The edges of all faces; with hidesRest, only the edges of highlighted faces.
  edgesOf(mesh, hidesRest) {
    const hasHidden = hidesRest && mesh.hasRest;
    if (mesh.edgesOfColouring === (hasHidden ? mesh.colouring : true)) return mesh.edges;
    mesh.edgesOfColouring = hasHidden ? mesh.colouring : true;
    mesh.edges ??= this.lines(mesh);
    const { ends, faces } = mesh.model.edges();
    const isSeen = (face) => face < mesh.colouring.length && mesh.colouring[face] >>> 24 !== 0;
    this.fillLines(mesh.edges, hasHidden ? ends.filter((_, i) => isSeen(faces[i & ~1]) || isSeen(faces[i | 1])) : ends);
    return mesh.edges;
  }

  /** The edges of sharp corners, and those of a boundary; null for large meshes. */
  creasesOf(mesh) {
    if (mesh.creases !== undefined || mesh.model.faceCount > kMostCreasedFaces) return mesh.creases ?? null;
    mesh.creases = this.lines(mesh);
    this.fillLines(mesh.creases, mesh.model.creases(kCreaseCosine));
    return mesh.creases;
  }

  /** vertex: name of the vertex shader, if several programs share it. */
  program(name, defines, vertex = name) {
    const key = [name, ...defines].join();
    if (this.programs.has(key)) return this.programs.get(key);
    const { gl } = this;
    const head = `#version 300 es\nprecision highp float;\n${defines.map((word) => `#define ${word}\n`).join('')}`;
    const program = gl.createProgram();
    for (const [type, stage] of [[gl.VERTEX_SHADER, `${vertex}_vertex`], [gl.FRAGMENT_SHADER, `${name}_fragment`]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, `${head}${shaders.light}\n${shaders[stage]}`);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error(`shader ${name}: ${gl.getProgramInfoLog(program)}`);
    const uniforms = {};
    for (let i = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) - 1; i >= 0; --i) {
      const { name: uniform } = gl.getActiveUniform(program, i);
      uniforms[uniform] = gl.getUniformLocation(program, uniform);
    }
    this.programs.set(key, { program, uniforms });
    return this.programs.get(key);
  }

  use(program, pane) {
    const { gl } = this;
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(program.uniforms.toClip, false, pane.camera.matrix());
    if (program.uniforms.toEye) gl.uniformMatrix3fv(program.uniforms.toEye, false, pane.camera.rotation());
    if (program.uniforms.plane) gl.uniform4fv(program.uniforms.plane, pane.plane ?? [0, 0, 0, 1]);
  }

  // frame: {width, height, background, isSampled, isCoarse, shading, back, edges, creases, rest, lineColour, glows, panes}.
  // A pane is {mesh, surface, camera, plane, viewport, outline, background}. viewport: in pixels from the lower left
  // corner of the canvas. If `surface` is not null, it is highlighted instead of faces of the mesh. glows: highlighted
  // faces have a halo and are not shaded.
  draw(frame) {
    const { gl } = this;
    const panes = frame.panes.map((shown) => {
      const mesh = frame.isCoarse ? this.coarse(shown.mesh) : shown.mesh;
      // The surface is not shown with the coarse copy, because the two do not fit each other.
      const surface = mesh === shown.mesh ? shown.surface : null;
      return { ...shown, mesh, surface, highlighted: surface ?? (mesh.hasRest && !mesh.isAllRest ? mesh : null) };
    });
    const target = frame.isSampled ? this.sampledTarget(frame.width, frame.height) : null;
    const shining = frame.rest === 'glass' ? panes.filter(({ highlighted }) => highlighted) : [];
    if (shining.length) this.glow.prepare(frame, shining);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...frame.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    for (const pane of panes) {
      gl.viewport(...pane.viewport);
      gl.scissor(...pane.viewport);
      if (pane.background) {
        gl.clearColor(...pane.background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      }
      this.drawPane(pane, frame, shining.includes(pane));
    }
    gl.disable(gl.SCISSOR_TEST);
    if (!target) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, target);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const area = [0, 0, frame.width, frame.height];
    gl.blitFramebuffer(...area, ...area, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  // Draws the rest in grey, then what shines through it, then the highlighted faces.
  drawPane(pane, frame, shines) {
    const { gl } = this, { mesh, highlighted } = pane, hasRest = Boolean(pane.surface) || mesh.hasRest;
    if (hasRest && (frame.rest !== 'hidden' || !highlighted)) this.drawFaces(mesh, pane, frame, 1);
    const creases = frame.creases && !frame.edges && (!hasRest || frame.rest !== 'hidden') ? this.creasesOf(mesh) : null;
    const lines = (shown) => this.drawLines(pane, frame.lineColour, shown.vao, () => gl.drawElements(gl.LINES, shown.count, gl.UNSIGNED_INT, 0));
    if (hasRest && creases) lines(creases);
    if (shines) this.glow.draw(frame);
    if (highlighted) {
      // Draws the highlighted faces slightly nearer than the mesh. Without this offset, rounding of the coordinates
      // could hide the highlighted faces.
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(-1, -1024);
      this.drawFaces(highlighted, pane, frame.glows ? { ...frame, shading: 'plain' } : frame);
      gl.disable(gl.POLYGON_OFFSET_FILL);
    } else if (!hasRest) {
      this.drawFaces(mesh, pane, frame);
      if (creases) lines(creases);
    }
    if (frame.edges) lines(this.edgesOf(mesh, frame.rest === 'hidden'));
    if (pane.outline) this.drawOutline(pane);
  }

  // With an opacity, draws the whole mesh in the colour of the rest. With null, draws the highlighted faces in their
  // colours.
  drawFaces(mesh, pane, frame, opacity = null) {
    const { gl } = this, isSmooth = frame.shading === 'smooth';
    const defines = isSmooth ? ['SMOOTH'] : [];
    if (opacity !== null) defines.push('REST');
    if (pane.plane || (opacity === null && mesh.hasRest)) defines.push('CUT');
    if (isSmooth) this.smooth(mesh);
    const program = this.program('mesh', defines);
    this.use(program, pane);
    gl.uniform4fv(program.uniforms.backColour, [0.44, 0.44, 0.46, frame.back === 'grey' ? 1 : 0]);
    if (opacity !== null) gl.uniform4fv(program.uniforms.restColour, [...kRestGrey, opacity]);
    gl.uniform1f(program.uniforms.plainness, frame.shading === 'plain' ? 1 : 0);
    const toggle = (capability, isOn) => isOn ? gl.enable(capability) : gl.disable(capability);
    toggle(gl.CULL_FACE, frame.back === 'hidden');
    gl.bindVertexArray(mesh.vao);
    gl.drawElements(gl.TRIANGLES, mesh.indexCount, gl.UNSIGNED_INT, 0);
  }

  drawLines(pane, colour, vao, call) {
    const { gl } = this;
    const program = this.program('line', []);
    this.use(program, pane);
    gl.uniform4fv(program.uniforms.lineColour, colour);
    // Moves the line in front of its faces.
    gl.uniform1f(program.uniforms.lift, 2 * pane.camera.pixelSize * pane.camera.depth);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);  // Keeps the canvas opaque.
    gl.bindVertexArray(vao);
    call();
    gl.disable(gl.BLEND);
  }

  // Draws over everything else. pane.outline: corners of a triangle.
  drawOutline(pane) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.outline.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(pane.outline.flat()), gl.STREAM_DRAW);
    gl.disable(gl.DEPTH_TEST);
    this.drawLines({ ...pane, plane: null }, [1, 0.2, 0.1, 1], this.outline.vao, () => gl.drawArrays(gl.LINE_LOOP, 0, 3));
    gl.enable(gl.DEPTH_TEST);
  }

  sampledTarget(width, height) {
    const { gl } = this;
    this.target ??= { framebuffer: gl.createFramebuffer(), colour: gl.createRenderbuffer(), depth: gl.createRenderbuffer() };
    const { target } = this;
    if (target.width !== width || target.height !== height) {
      Object.assign(target, { width, height });
      gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
      for (const [buffer, format, point] of [[target.colour, gl.RGB8, gl.COLOR_ATTACHMENT0],
        [target.depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorageMultisample(gl.RENDERBUFFER, kSampleCount, format, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, point, gl.RENDERBUFFER, buffer);
      }
    }
    return target.framebuffer;
  }
}
