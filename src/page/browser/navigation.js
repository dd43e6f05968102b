// Handles mouse, touch and keys on the view.
import { kViews } from './camera.js';
import { add, clamp, scaled, subtract } from './vectors.js';

const kDegreesPerPixel = 0.45, kClickPixels = 4;

export class Navigation {
  constructor(viewer) {
    this.viewer = viewer;
    this.pointers = new Map();
    const { canvas } = viewer;
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => this.release(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1);
      this.zoom(Math.exp(-clamp(pixels, -300, 300) * 0.0015), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener('dblclick', (event) => {
      const hit = viewer.hit(event.offsetX, event.offsetY);
      if (hit) viewer.flyTo(hit.pane.camera.stateAt(hit.point));
    });
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  get state() {
    return this.viewer.state;
  }

  set(changes) {
    this.viewer.flight = null;
    this.viewer.store.set(changes);
  }

  turn(dx, dy) {
    this.set({ az: (this.state.az - dx) % 360, el: clamp(this.state.el + dy, -90, 90) });
  }

  pan(dx, dy) {
    const [{ camera }] = this.viewer.panes(), { width, height } = camera;
    this.set(camera.stateAt(camera.pointAt(width / 2 - dx, height / 2 - dy)));
  }

  /** Zooms about a pixel of the canvas; without x, about the centre of the view. */
  zoom(factor, x, y) {
    const panes = this.viewer.panes();
    const pane = panes.find((p) => x >= p.left && y >= p.top && x < p.left + p.width && y < p.top + p.height) ?? panes[0];
    const zoom = clamp(this.state.zoom * factor, 0.05, 1e4), change = {};
    if (x !== undefined) {
      const { camera } = pane, fixed = camera.pointAt(x - pane.left, y - pane.top);
      const target = add(fixed, scaled(subtract(camera.target, fixed), this.state.zoom / zoom));
      Object.assign(change, camera.stateAt(target));
    }
    this.set({ zoom, ...change });
  }

  press(event) {
    const { canvas } = this.viewer;
    canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    this.pressed = this.pointers.size === 1 ? [event.offsetX, event.offsetY] : null;
  }

  move(event) {
    const from = this.pointers.get(event.pointerId);
    if (!from) return;
    const to = [event.offsetX, event.offsetY];
    if (this.pressed && Math.hypot(to[0] - this.pressed[0], to[1] - this.pressed[1]) < kClickPixels) return;
    this.pressed = null;
    this.pointers.set(event.pointerId, to);
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (other) {
      const distance = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
      this.zoom(distance(to) / distance(from), (to[0] + other[0]) / 2, (to[1] + other[1]) / 2);
      this.pan(dx / 2, dy / 2);
    } else if (event.buttons & 6 || event.shiftKey || event.ctrlKey) {
      this.pan(dx, dy);
    } else {
      this.turn(dx * kDegreesPerPixel, dy * kDegreesPerPixel);
    }
  }

  release(event) {
    if (this.pressed && event.type === 'pointerup' && event.button === 0) this.viewer.pickAt(...this.pressed.map((value) => Math.floor(value) + 0.5));
    this.pressed = null;
    this.pointers.delete(event.pointerId);
  }

  view(name) {
    const [az, el] = kViews[name];
    this.viewer.flyTo({ az, el });
  }

  resetView() {
    const { state, viewer } = this, { az, el } = viewer.initial;
    viewer.flyTo({ az, el, ...viewer.fitted({ ...state, az, el }) });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = 5, shift = event.shiftKey ? 30 : 0, { clientWidth, clientHeight } = this.viewer.canvas;
    const move = (x, y) => shift ? this.pan(-x * shift, -y * shift) : this.turn(x * step, y * step);
    const actions = {
      ArrowLeft: () => move(1, 0), ArrowRight: () => move(-1, 0), ArrowUp: () => move(0, 1), ArrowDown: () => move(0, -1),
      '+': () => this.zoom(1.2), '=': () => this.zoom(1.2), '-': () => this.zoom(1 / 1.2), _: () => this.zoom(1 / 1.2),
      0: () => this.resetView(), Home: () => this.resetView(), Escape: () => this.set({ face: null, part: null, place: null }),
      Enter: () => this.viewer.pickAt(clientWidth / 2, clientHeight / 2),
    };
    Object.keys(kViews).forEach((name, i) => actions[i + 1] = () => this.view(name));
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }
}
