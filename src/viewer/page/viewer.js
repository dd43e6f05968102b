// The view: colours and cameras of the panes from the state, frames, selection.
import { anglesTowards, boxCorners, PaneCamera, viewAxes } from './camera.js';
import { colourFaces } from './face_colours.js';
import { Layers } from './layers.js';
import { pickFace } from './picking.js';
import { kInitialState, stateOfFragment } from './view_state.js';
import { add, clamp, dot, scaled, subtract } from './vectors.js';

const kColourKeys = ['layer', 'show', 'map', 'low', 'high', 'none', 'thin', 'thinAt', 'rest', 'part'];
const kCameraKeys = ['up', 'az', 'el', 'zoom', 'x', 'y', 'z', 'clipAt'];
const kRestMilliseconds = 180;  // Without motion, before a frame in full quality.
const kSlowMilliseconds = 36, kSlowCount = 3;
// Of frames while the view moves, on ever slower devices: resolution, and whether the mesh is a coarse copy.
const kLevels = [[1, false], [1, true], [0.7, true], [0.5, true], [0.35, true]];
const kFlightMilliseconds = 350;

export class Viewer {
  constructor(canvas, renderer, models, store) {
    Object.assign(this, { canvas, renderer, models, store, afterFrame: [], level: Number(renderer.isSoftware), slowCount: 0, frameMilliseconds: 0 });
    this.layers = new Layers(models);
    this.frames = framesOf(models);
    this.restore();
    this.reset();
    store.set(this.validated(stateOfFragment(location.hash)));
    this.isStale = true;
    store.listeners.push((keys) => this.changed(keys));
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.isLost = true;
      document.documentElement.dataset.state = 'lost';
    });
    canvas.addEventListener('webglcontextrestored', () => {
      renderer.restore();
      this.restore();
      this.isLost = false;
      this.isStale = true;
      document.documentElement.dataset.state = 'ready';
      this.requestFrame();
    });
    new ResizeObserver(() => this.requestFrame()).observe(canvas);
  }

  get state() {
    return this.store.state;
  }

  restore() {
    this.meshes = this.models.map((model) => this.renderer.addMesh(model));
  }

  /** Camera and everything else as at the start. */
  reset() {
    const first = this.layers.fields.find((field) => field.kind === 'number') ?? this.layers.fields[0];
    const up = this.models[0].description.up ?? 'y';
    this.initial = { ...kInitialState, layer: first?.name ?? null, up, ...this.fitted({ ...kInitialState, up }) };
    this.flight = null;
    this.store.set(this.initial);
  }

  /** Zoom and target that show everything from the direction of the state. */
  fitted(state) {
    const axes = viewAxes(state, this.frames[0].size), [pane] = this.rectangles(this.models.length);
    const shadows = [axes.right, axes.up].map((axis) => this.shadow(axis));
    const sides = [pane.width, pane.height], short = Math.min(...sides);
    const zooms = shadows.map(([low, high], i) => 2 * sides[i] / short / (high - low));
    const middles = shadows.map(([low, high]) => (low + high) / 2);
    const [x, y, z] = add(scaled(axes.right, middles[0]), scaled(axes.up, middles[1]));
    return { x, y, z, zoom: clamp(0.9 * Math.min(...zooms), 0.5, 20) };
  }

  // Extent of all meshes along an axis, in radii of their frames; from some of the points where there are many.
  shadow(axis) {
    let low = Infinity, high = -Infinity;
    this.models.forEach(({ positions }, index) => {
      const { centre, radius } = this.frames[index], shift = dot(centre, axis);
      const step = 3 * Math.ceil(positions.length / 600000);
      for (let i = 0; i < positions.length; i += step) {
        const at = (positions[i] * axis[0] + positions[i + 1] * axis[1] + positions[i + 2] * axis[2] - shift) / radius;
        if (at < low) low = at;
        if (at > high) high = at;
      }
    });
    return low < high ? [low, high] : [-1e-3, 1e-3];
  }

  /** Without values that this page cannot show. */
  validated(state) {
    const isMesh = (index) => Number(index) < this.models.length;
    if (state.layer !== undefined && this.layers.fieldNamed(state.layer)?.name !== state.layer) delete state.layer;
    if (state.show && state.show !== 'all' && !state.show.split('-').every(isMesh)) delete state.show;
    if (state.show?.includes('-') && !this.layers.areComparable(...state.show.split('-').map(Number))) delete state.show;
    for (const key of ['face', 'part']) if (state[key] && !isMesh(state[key].split(':')[0])) delete state[key];
    if (state.zoom === null) delete state.zoom;
    if (state.zoom !== undefined) state.zoom = clamp(state.zoom, 0.05, 1e4);
    if (state.el !== undefined) state.el = clamp(state.el, -90, 90);
    return state;
  }

  changed(keys) {
    if (kColourKeys.some((key) => keys.has(key))) this.isStale = true;
    if (kCameraKeys.some((key) => keys.has(key))) this.hasMoved = true;
    this.requestFrame();
  }

  /** Layer, range and panes; computed once per change of the state. */
  get look() {
    if (this.isStale) {
      const { state, layers } = this;
      this.isStale = false;
      this.currentLook = layers.fields.length ? layers.look(state) : { kind: 'none', panes: [] };
      this.limit = state.thin && this.currentLook.kind === 'number' ? state.thinAt ?? this.currentLook.low : null;
      for (const pane of this.currentLook.panes) this.recolour(pane);
    }
    return this.currentLook;
  }

  recolour({ index, values }) {
    const { state, layers, currentLook: look } = this;
    const [partMesh, label] = state.part ? state.part.split(':').map(Number) : [-1];
    const hasParts = this.models[index].description.fields.some(({ name }) => name === 'segment');
    const part = partMesh === index && hasParts ? { labels: layers.valuesOf(index, 'segment'), label } : null;
    const style = { none: state.none, limit: this.limit, part, hidesRest: state.rest === 'hidden' };
    const layer = look.kind === 'label' ? { ...look, colours: layers.labelColours(index, look.name) } : look;
    this.renderer.setColours(this.meshes[index], colourFaces(values, layer, style));
  }

  /** Panes of the canvas in CSS pixels: the grid in which they are largest. */
  rectangles(count) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    let best = { side: 0 };
    for (let columns = 1; columns <= count; ++columns) {
      const rows = Math.ceil(count / columns), side = Math.min(width / columns, height / rows);
      if (side > best.side) best = { side, columns, rows };
    }
    const { columns = 1, rows = 1 } = best;
    return Array.from({ length: count }, (_, i) => ({
      left: (i % columns) * width / columns, top: Math.floor(i / columns) * height / rows,
      width: Math.max(width / columns, 1), height: Math.max(height / rows, 1),
    }));
  }

  /** With cameras and clip planes, in the order of look.panes. */
  panes() {
    const { panes } = this.look, rectangles = this.rectangles(panes.length);
    return panes.map(({ index, values }, i) => {
      const frame = this.frames[index], rectangle = rectangles[i];
      const camera = new PaneCamera(this.state, viewAxes(this.state, this.frames[0].size), frame, rectangle.width, rectangle.height);
      return { ...rectangle, index, values, camera, plane: this.clipPlane(frame, camera), mesh: this.meshes[index] };
    });
  }

  clipPlane(frame, camera) {
    const { clip, clipAt, clipFlip } = this.state;
    if (clip === 'off') return null;
    const axis = clip === 'view' ? camera.toViewer : [0, 1, 2].map((i) => Number(i === 'xyz'.indexOf(clip)));
    const extent = Math.max(...boxCorners(frame.size).map((corner) => dot(corner, axis)));
    const offset = dot(frame.centre, axis) + (2 * clipAt - 1) * extent, sign = clipFlip ? 1 : -1;
    return [...scaled(axis, sign), -sign * offset];
  }

  requestFrame() {
    if (this.isPending) return;
    this.isPending = true;
    document.documentElement.dataset.still = 'false';
    requestAnimationFrame((time) => {
      this.isPending = false;
      this.frame(time);
    });
  }

  frame(time) {
    if (this.isLost || !this.canvas.clientWidth) return;
    this.fly(time);
    const isMoving = Boolean(this.hasMoved);
    this.hasMoved = false;
    // The next frame is late where the device is slow, whatever the interval between two inputs.
    if (isMoving) requestAnimationFrame((next) => this.adapt(next - time));
    // The first frame is early rather than smooth.
    const { dataset } = document.documentElement, isFirst = !dataset.frames;
    this.draw(!isMoving, isFirst);
    if (isFirst) this.requestFrame();
    clearTimeout(this.timer);
    const rest = Math.max(kRestMilliseconds, 2 * this.frameMilliseconds);
    if (isMoving) this.timer = setTimeout(() => this.requestFrame(), rest);
    dataset.frames = Number(dataset.frames ?? 0) + 1;
    if (!isMoving && !this.isPending) dataset.still = 'true';
  }

  // Less detail while moving, where several frames took long.
  adapt(milliseconds) {
    this.frameMilliseconds = milliseconds;
    if (this.frameMilliseconds > kSlowMilliseconds) ++this.slowCount;
    else if (this.slowCount > 0) --this.slowCount;
    if (this.slowCount < kSlowCount || this.level === kLevels.length - 1) return;
    ++this.level;
    this.slowCount = 0;
  }

  /** In full quality, or in that of motion. */
  draw(isStill, isFirst = false) {
    const { canvas, state } = this;
    const [share, isCoarse] = isStill ? [1, false] : kLevels[this.level];
    const scale = Math.min(devicePixelRatio, 2) * share;
    const width = Math.max(Math.round(canvas.clientWidth * scale), 1);
    const height = Math.max(Math.round(canvas.clientHeight * scale), 1);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const panes = this.panes(), selected = this.selected();
    for (const pane of panes) {
      pane.viewport = [pane.left, canvas.clientHeight - pane.top - pane.height, pane.width, pane.height]
        .map((value) => Math.round(value * scale));
      const face = selected ? this.faceIn(pane.index, selected) : -1;
      if (face >= 0) pane.outline = [0, 1, 2].map((corner) => this.models[pane.index].corner(face, corner));
    }
    const { background, isDark } = this.theme();
    this.renderer.draw({
      width, height, background, panes, isSampled: isStill && !isFirst, isCoarse, shading: state.shading, back: state.back, edges: state.edges,
      lineColour: isDark ? [0, 0, 0, 0.5] : [0, 0, 0, 0.4],
    });
    for (const listener of this.afterFrame) listener(panes);
  }

  theme() {
    const style = getComputedStyle(this.canvas);
    const bytes = style.backgroundColor.match(/[\d.]+/g).map(Number);
    return { background: bytes.slice(0, 3).map((byte) => byte / 255), isDark: bytes[0] < 128, ink: style.color };
  }

  /** {index, face} of the selected face, or null. */
  selected() {
    if (!this.state.face) return null;
    const [index, id] = this.state.face.split(':').map(Number), face = this.models[index].faceOfId(id);
    return face < 0 ? null : { index, face, id };
  }

  /** The selected face in another result of the same mesh, or -1. */
  faceIn(index, selected) {
    if (index === selected.index) return selected.face;
    return this.layers.areComparable(index, selected.index) ? this.layers.sameFace(selected.index, selected.face, index) : -1;
  }

  /** The pane and the face at a point of the canvas, {pane, face, point} or null. */
  hit(x, y) {
    const pane = this.panes().find((p) => x >= p.left && y >= p.top && x < p.left + p.width && y < p.top + p.height);
    if (!pane) return null;
    const point = pane.camera.pointAt(x - pane.left, y - pane.top);
    const found = pickFace(this.models[pane.index], pane.mesh.colouring, point, pane.camera.toViewer, pane.plane,
      this.state.back === 'hidden');
    return found && { pane, ...found };
  }

  pickAt(x, y) {
    const hit = this.hit(x, y);
    this.store.set({ face: hit ? `${hit.pane.index}:${this.models[hit.pane.index].faceIds[hit.face]}` : null });
  }

  /** Moves the camera to `goal` of the state. */
  flyTo(goal) {
    const start = Object.fromEntries(Object.keys(goal).map((key) => [key, this.state[key]]));
    if (goal.az !== undefined) goal.az = start.az + ((goal.az - start.az + 540) % 360 + 360) % 360 - 180;
    this.flight = { start, goal, begin: performance.now() };
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.flight.begin -= kFlightMilliseconds;
    this.requestFrame();
  }

  fly() {
    if (!this.flight) return;
    const { start, goal, begin } = this.flight, share = clamp((performance.now() - begin) / kFlightMilliseconds, 0, 1);
    const eased = share * share * (3 - 2 * share);
    const mix = (key) => key === 'zoom' ? start.zoom * (goal.zoom / start.zoom) ** eased
      : start[key] + (goal[key] - start[key]) * eased;
    this.store.set(Object.fromEntries(Object.keys(goal).map((key) => [key, mix(key)])));
    if (share >= 1) this.flight = null;
    else this.requestFrame();
  }

  /** Flies to a point of mesh `index` with a neighbourhood of this area; direction: to the viewer, or null. */
  visit(index, point, area, direction) {
    const frame = this.frames[index], relative = scaled(subtract(point, frame.centre), 1 / frame.radius);
    const angles = direction ? anglesTowards(direction, this.state.up, this.frames[0].size) : {};
    const zoom = clamp(0.35 * frame.radius / Math.sqrt(area + 1e-30), this.initial.zoom, 12);
    this.flyTo({ x: relative[0], y: relative[1], z: relative[2], zoom, ...angles });
  }

  visitFace(index, id, area) {
    const model = this.models[index], face = model.faceOfId(id);
    if (face < 0) return false;
    const normal = Array.from(model.normals.subarray(4 * face, 4 * face + 3), (byte) => byte / 127);
    this.visit(index, model.centreOf(face), Math.max(area, 40 * model.areas[face]), dot(normal, normal) > 0 ? normal : null);
    this.store.set({ face: `${index}:${id}`, show: this.showing(index) });
    return true;
  }

  visitPart(index, part) {
    const model = this.models[index], { centre } = this.frames[index];
    const point = subtract(part.centre, model.origin), outwards = subtract(point, centre);
    const length = Math.hypot(...outwards);
    this.visit(index, point, part.area, length > 0 ? scaled(outwards, 1 / length) : null);
    this.store.set({ part: `${index}:${part.label}`, show: this.showing(index) });
  }

  // The state `show` with which the mesh is visible.
  showing(index) {
    return this.look.panes.some((pane) => pane.index === index) ? this.state.show : String(index);
  }
}

/** Centre, size and radius that the camera refers to: common ones where the meshes are about the same box. */
function framesOf(models) {
  const frameOf = (low, high) => {
    const size = subtract(high, low);
    return { centre: scaled(add(low, high), 0.5), size, radius: Math.hypot(...size) / 2 || 1 };
  };
  const absolute = models.map(({ description }) => frameOf(description.boxMin, description.boxMax));
  const [first] = absolute;
  const areAlike = absolute.every((frame) => Math.hypot(...subtract(frame.centre, first.centre)) < 0.3 * first.radius
    && frame.radius < 2 * first.radius && first.radius < 2 * frame.radius);
  const end = (name, choose) => [0, 1, 2].map((axis) => choose(...models.map((model) => model.description[name][axis])));
  const common = frameOf(end('boxMin', Math.min), end('boxMax', Math.max));
  return models.map(({ origin }, i) => {
    const frame = areAlike ? common : absolute[i];
    return { ...frame, centre: subtract(frame.centre, origin) };
  });
}
