// Moves the camera smoothly ("flies") to faces, places and parts.
import { anglesTowards, PaneCamera } from './camera.js';
import { directionOfLeastCover, givenLimit, placeAt, regionRadius } from './thin_places.js';
import { add, clamp, dot, scaled, subtract, unit } from './vectors.js';

const kPlaceShare = 10;  // Width of the view in sizes of the place.

export class Visits {
  constructor(viewer) {
    this.viewer = viewer;
  }

  /** Flies to a point of mesh `index`. direction: direction to the viewer; null: unchanged. */
  fly(index, point, zoom, direction) {
    const axes = this.viewer.axesOf(index, this.viewer.state), frame = this.viewer.frames[index];
    const angles = direction ? anglesTowards(direction, axes) : {};
    this.viewer.flyTo({ ...new PaneCamera(this.viewer.state, axes, frame, 1, 1).stateAt(point), zoom, ...angles });
  }

  /** The zoom that shows a part of this area and its surroundings. */
  zoomFor(index, area) {
    return clamp(0.35 * this.viewer.frames[index].radius / Math.sqrt(area + 1e-30), this.viewer.initial.zoom, 12);
  }

  face(index, id, area) {
    const model = this.viewer.models[index], face = model.faceOfId(id);
    if (face < 0) return false;
    const normal = Array.from(model.normals.subarray(4 * face, 4 * face + 3), (byte) => byte / 127);
    const zoom = this.zoomFor(index, Math.max(area, 40 * model.areas[face]));
    this.fly(index, model.centreOf(face), zoom, dot(normal, normal) > 0 ? normal : null);
    this.viewer.store.set({ face: `${index}:${id}`, show: this.showing(index) });
    return true;
  }

  // Flies to a place of placesOf(). The place takes about a tenth of the view. Walls in front of it stay, and its colour
  // shines through them.
  place(index, number) {
    const { viewer } = this, model = viewer.models[index], { radius } = viewer.frames[index];
    const { region } = placeAt(model, number), ends = [region.place, region.opposite].map((end) => subtract(end, model.origin));
    const span = subtract(ends[0], ends[1]), thickness = Math.hypot(...span), face = model.faceOfId(region.face);
    const normal = face < 0 ? [0, 0, 1] : Array.from(model.normals.subarray(4 * face, 4 * face + 3));
    const outward = thickness > 1e-6 * radius ? scaled(span, 1 / thickness) : unit(normal, [0, 0, 1]);
    const axes = viewer.axesOf(index, viewer.state), point = scaled(add(...ends), 0.5);
    const direction = directionOfLeastCover(model, ends, outward, axes, 1e-4 * radius);
    const { surface, regionOfTriangle } = model.thin ?? {};
    const extent = number >= 0 && surface ? 2 * regionRadius(surface, regionOfTriangle, number, point) : thickness;
    const size = Math.max(thickness ? clamp(extent, thickness, 5 * thickness) : Math.min(extent, radius / 10), radius / 100);
    const [{ width, height }] = viewer.rectangles(1), seen = kPlaceShare * size * Math.min(width, height) / width;
    this.fly(index, point, Math.max(2 * radius / seen, viewer.initial.zoom), direction);
    const hasLimit = givenLimit(viewer.models) !== null;
    viewer.store.set({
      place: `${index}:${number}`, face: null, part: null, show: this.showing(index), thin: hasLimit, thinAt: null,
      rest: viewer.state.rest === 'grey' ? 'glass' : viewer.state.rest,
    });
  }

  part(index, part) {
    const model = this.viewer.models[index], { centre } = this.viewer.frames[index];
    const point = subtract(part.centre, model.origin), outwards = subtract(point, centre);
    const length = Math.hypot(...outwards), { toViewer } = this.viewer.axesOf(index, this.viewer.state);
    this.fly(index, point, this.zoomFor(index, part.area), length > 0 ? unit(add(scaled(outwards, 1 / length), toViewer), toViewer) : null);
    this.viewer.store.set({ part: `${index}:${part.label}`, place: null, face: null, thin: false, layer: this.viewer.layers.has('segment') ? 'segment' : this.viewer.state.layer, show: this.showing(index) });
  }

  // The value of `show` with which the mesh is visible.
  showing(index) {
    return this.viewer.look.panes.some((pane) => pane.index === index) ? this.viewer.state.show : String(index);
  }
}
