// The view. Computes colours and cameras of the panes from the state, draws frames and selects faces.
import { columnWidth } from './callouts.js';
import { boxCorners, framesOf, kViews, PaneCamera, viewAxes } from './camera.js';
import { kAlarmColour, kUncountedColour } from './colour_maps.js';
import { colourFaces } from './face_colours.js';
import { formatValue } from './format.js';
import { insetOf, needsInset } from './inset.js';
import { Layers } from './layers.js';
import { classTitle } from './legend.js';
import { pickFace } from './picking.js';
import { givenLimit, isCounted, placeAt, thinShown } from './thin_places.js';
import { kInitialState, stateOfFragment } from './view_state.js';
import { add, clamp, dot, scaled } from './vectors.js';

const kMeasured = /^(least_)?(thickness|gap)/;  // Names of the fields of walls and gaps.
const kColourKeys = ['layer', 'show', 'map', 'low', 'high', 'none', 'thin', 'thinAt', 'part'];
const kCameraKeys = ['up', 'az', 'el', 'zoom', 'x', 'y', 'z', 'clipAt'];
const kRestMilliseconds = 180;  // Time without motion before a frame in full quality.
const kSlowMilliseconds = 36, kSlowCount = 3;
// Levels of detail during motion, from fast to slow devices: share of the resolution; whether a coarse copy is drawn.
const kLevels = [[1, false], [1, true], [0.7, true], [0.5, true], [0.35, true]];
const kFlightMilliseconds = 350;

export class Viewer {
  constructor(canvas, renderer, store) {
    Object.assign(this, { canvas, renderer, store, models: [], meshes: [], surfaces: [], afterFrame: [], afterLoad: [], generation: 0 });
    Object.assign(this, { level: Number(renderer.isSoftware), slowCount: 0, frameMilliseconds: 0 });
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

  /** Replaces the models. keepsView: the camera and the upright axis stay. */
  load(models, keepsView = false) {
    for (const mesh of [...this.meshes, ...this.surfaces]) if (mesh) this.renderer.release(mesh);
    const { az, el, zoom, x, y, z, up } = this.state;
    this.models = models;
    this.layers = new Layers(models);
    this.frames = framesOf(models);
    this.isStale = true;
    ++this.generation;
    this.restore();
    this.reset();
    if (keepsView) this.store.set({ az, el, zoom, x, y, z, up });
    for (const listener of this.afterLoad) listener();
    this.requestFrame();
  }

  restore() {
    this.meshes = this.models.map((model) => this.renderer.addMesh(model));
    this.surfaces = this.models.map(({ thin }) => {
      if (!thin?.surface.faceCount) return null;
      const surface = this.renderer.addMesh(thin.surface), { regionOfTriangle: regions } = thin;
      this.renderer.setColours(surface, Uint32Array.from({ length: thin.surface.faceCount },
        (_, face) => isCounted(thin, thin.regions[regions[face]] ?? {}) ? kAlarmColour : kUncountedColour));
      return surface;
    });
  }

  /** Restores the initial state: the thin places if a result has a limit, else the first field. */
  reset() {
    const [first] = this.layers.fields;
    const thin = givenLimit(this.models) !== null;
    const layer = thin && this.layers.has('least_thickness') ? 'least_thickness' : first?.name ?? null;
    const [az, el] = this.models[0].description.view ?? kViews.corner, view = { ...kInitialState, az, el };
    this.initial = { ...view, layer, thin, ...this.fitted(view) };
    this.flight = null;
    this.store.set(this.initial);
  }

  /** Axes of the view of a mesh. The state selects the upright axis; `auto` is the axis of the mesh. */
  axesOf(index, state) {
    const up = state.up === 'auto' ? this.models[index].description.up ?? 'y' : state.up;
    return viewAxes({ ...state, up }, this.frames[index].size);
  }

  /** Zoom and target with which the state shows all its meshes completely. */
  fitted(state) {
    const indices = this.layers.shown(state), [pane] = this.rectangles(indices.length);
    const shadows = ['right', 'up'].map((axis) => this.shadow(indices, axis, state));
    const short = Math.min(pane.width, pane.height), hasPlaces = indices.some((index) => this.models[index].thin || this.models[index].description.least);
    const sides = [pane.width - (hasPlaces ? 2 * columnWidth(pane) : 0), pane.height - 40];
    const zooms = shadows.map(([low, high], i) => 2 * sides[i] / short / (high - low));
    const middles = shadows.map(([low, high]) => (low + high) / 2);
    const axes = this.axesOf(indices[0], state), middle = add(scaled(axes.right, middles[0]), scaled(axes.up, middles[1]));
    const [x, y, z] = axes.upright.map((axis) => dot(middle, axis));
    return { x, y, z, zoom: clamp(0.92 * Math.min(...zooms), 0.3, 20) };
  }

  // Extent [low, high] of the meshes along right or up, in radii of their frames. Large meshes are sampled.
  shadow(indices, name, state) {
    let low = Infinity, high = -Infinity;
    indices.forEach((index) => {
      const { positions } = this.models[index], axis = this.axesOf(index, state)[name];
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

  /** Removes the values of a state that this page cannot show. */
  validated(state) {
    const isMesh = (index) => Number(index) < this.models.length;
    if (state.layer !== undefined && this.layers.fieldNamed(state.layer)?.name !== state.layer) delete state.layer;
    if (state.show && state.show !== 'all' && !state.show.split('-').every(isMesh)) delete state.show;
    if (state.show?.includes('-') && !this.layers.areComparable(...state.show.split('-').map(Number))) delete state.show;
    for (const key of ['face', 'part', 'place']) if (state[key] && !isMesh(state[key].split(':')[0])) delete state[key];
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

  /** The result of Layers.look(), computed once per change of the state. */
  get look() {
    if (this.isStale) {
      const { state, layers } = this;
      this.isStale = false;
      this.currentLook = layers.fields.length ? layers.look(state) : { kind: 'none', panes: [] };
      this.thin = thinShown(state, this.currentLook, layers);
      for (const pane of this.currentLook.panes) this.recolour(pane);
    }
    return this.currentLook;
  }

  recolour({ index, values }) {
    const { state, layers, currentLook: look, thin } = this;
    const [partMesh, label] = state.part ? state.part.split(':').map(Number) : [-1];
    const hasParts = this.models[index].description.fields.some(({ name }) => name === 'segment');
    const part = partMesh === index && hasParts ? { labels: layers.valuesOf(index, 'segment'), label } : null;
    const below = thin && { limit: thin.limit, values: thin.name === look.name ? values : layers.valuesOf(index, thin.name) };
    const style = { none: state.none, below, part };
    this.renderer.setColours(this.meshes[index], colourFaces(values, look, style));
  }

  /** Rectangles of the panes in CSS pixels, in the grid that makes the panes largest. */
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

  /** The panes with cameras and clip planes, in the order of look.panes. */
  panes() {
    const { panes } = this.look, rectangles = this.rectangles(panes.length);
    return panes.map(({ index, values }, i) => {
      const frame = this.frames[index], rectangle = rectangles[i];
      const camera = new PaneCamera(this.state, this.axesOf(index, this.state), frame, rectangle.width, rectangle.height);
      const surface = this.thin?.isGiven ? this.surfaces[index] : null;
      return { ...rectangle, index, values, camera, plane: this.clipPlane(frame, camera), mesh: this.meshes[index], surface };
    });
  }

  /** Whether the view shows walls or gaps, so that their places have callouts. */
  showsPlaces() {
    return this.thin ? this.thin.isGiven : kMeasured.test(this.look.name);
  }

  /** The selected place of mesh `index`, as in placesOf(). */
  selectedPlace(index) {
    const [mesh, place] = (this.state.place ?? '-1:0').split(':').map(Number);
    return mesh === index ? placeAt(this.models[index], place) : undefined;
  }

  /** The value of the selected face in the layer of a pane, as a text. */
  selectedValue({ index, values }) {
    const selected = this.selected(), face = selected ? this.faceIn(index, selected) : -1, { look } = this;
    if (face < 0 || !values) return '';
    const [value] = this.thin ? this.layers.valuesOf(index, this.thin.name).subarray(face, face + 1) : [values[face]];
    return Number.isNaN(value) ? 'no value' : this.thin || look.kind === 'number' ? `${formatValue(value)}${this.unit}` : classTitle(look, value);
  }

  /** The unit of lengths with a space before it; empty if the files have none. */
  get unit() {
    const [unit = ''] = this.layers.fields.map((field) => field.unit).filter((name) => /^(.m|m|in|ft)$/.test(name));
    return unit && ` ${unit}`;
  }

  titleOf(index) {
    const { name, label } = this.models[index].description;
    const isUnique = this.models.filter((model) => model.description.name === name).length < 2;
    return isUnique || !label ? name : label;
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
    if (this.isLost || !this.canvas.clientWidth || !this.models.length) return;
    this.fly(time);
    const isMoving = Boolean(this.hasMoved);
    this.hasMoved = false;
    // The delay of the next frame measures the speed of the device; the interval between two inputs does not.
    if (isMoving) requestAnimationFrame((next) => this.adapt(next - time));
    // The first frame is drawn without antialiasing, so that it appears early.
    const { dataset } = document.documentElement, isFirst = !dataset.frames;
    this.draw(!isMoving, isFirst);
    if (isFirst) this.requestFrame();
    clearTimeout(this.timer);
    const rest = Math.max(kRestMilliseconds, 2 * this.frameMilliseconds);
    if (isMoving) this.timer = setTimeout(() => this.requestFrame(), rest);
    dataset.frames = Number(dataset.frames ?? 0) + 1;
    if (!isMoving && !this.isPending) dataset.still = 'true';
  }

  // Reduces the detail of frames during motion after several slow frames.
  adapt(milliseconds) {
    this.frameMilliseconds = milliseconds;
    if (this.frameMilliseconds > kSlowMilliseconds) ++this.slowCount;
    else if (this.slowCount > 0) --this.slowCount;
    if (this.slowCount < kSlowCount || this.level === kLevels.length - 1) return;
    ++this.level;
    this.slowCount = 0;
  }

  /** Draws a frame. isStill: in full quality. isFirst: without antialiasing. */
  draw(isStill, isFirst = false) {
    const { canvas, state } = this;
    const [share, isCoarse] = isStill ? [1, false] : kLevels[this.level];
    const scale = Math.min(devicePixelRatio, 2) * share;
    const width = Math.max(Math.round(canvas.clientWidth * scale), 1);
    const height = Math.max(Math.round(canvas.clientHeight * scale), 1);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const { background, isDark, card } = this.theme(), shown = this.panes(), [first] = shown;
    const hasInset = shown.length === 1 && needsInset(state.zoom, this.initial.zoom);
    const panes = hasInset ? [first, insetOf(first, state, this.axesOf(first.index, state), card)] : shown, selected = this.selected();
    this.insetHeight = hasInset ? panes[1].height : 0;
    for (const pane of panes) {
      pane.viewport = [pane.left, canvas.clientHeight - pane.top - pane.height, pane.width, pane.height]
        .map((value) => Math.round(value * scale));
      const face = selected && !pane.isInset ? this.faceIn(pane.index, selected) : -1;
      if (face >= 0) pane.outline = [0, 1, 2].map((corner) => this.models[pane.index].corner(face, corner));
    }
    this.renderer.draw({
      width, height, scale, background, panes, glows: Boolean(this.thin), creases: isStill && !isFirst && state.shading !== 'plain',
      isSampled: isStill && !isFirst, isCoarse, shading: state.shading, back: state.back, edges: state.edges, rest: state.rest,
      lineColour: isDark ? [0, 0, 0, 0.5] : [0, 0, 0, 0.35],
    });
    for (const listener of this.afterFrame) listener(panes);
  }

  theme() {
    const style = getComputedStyle(this.canvas);
    const numbers = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map((byte) => byte / 255);
    const background = numbers(style.backgroundColor), card = numbers(style.borderTopColor);
    return { background, card, isDark: background[0] < 0.5, ink: style.color };
  }

  /** The selected face {index, face, id}, or null. */
  selected() {
    if (!this.state.face) return null;
    const [index, id] = this.state.face.split(':').map(Number), face = this.models[index].faceOfId(id);
    return face < 0 ? null : { index, face, id };
  }

  /** The face of mesh `index` that corresponds to the selected face; -1 if the meshes are not comparable. */
  faceIn(index, selected) {
    if (index === selected.index) return selected.face;
    return this.layers.areComparable(index, selected.index) ? this.layers.sameFace(selected.index, selected.face, index) : -1;
  }

  /** {pane, face, point} at a pixel of the canvas; null if there is no face. */
  hit(x, y) {
    const pane = this.panes().find((p) => x >= p.left && y >= p.top && x < p.left + p.width && y < p.top + p.height);
    if (!pane) return null;
    const point = pane.camera.pointAt(x - pane.left, y - pane.top);
    const colours = this.state.rest === 'hidden' ? pane.mesh.colouring : null;
    const found = pickFace(this.models[pane.index], colours, point, pane.camera.toViewer, pane.plane, this.state.back === 'hidden');
    return found && { pane, ...found };
  }

  pickAt(x, y) {
    const hit = this.hit(x, y);
    this.store.set({ face: hit ? `${hit.pane.index}:${this.models[hit.pane.index].faceIds[hit.face]}` : null });
  }

  /** Moves the camera smoothly to `goal`, the values of the state to reach. */
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
}
