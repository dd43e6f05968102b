// Moves the camera smoothly ("flies") to faces, thin regions and parts.
import { anglesTowards, PaneCamera } from './camera.js';
import { directionOfLeastCover, regionRadius } from './thin_places.js';
import { add, clamp, dot, scaled, subtract, unit } from './vectors.js';

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

  /** Flies to the thinnest place of a thin region. Walls in front of that place become translucent. */
  region(index, number) {
    const model = this.viewer.models[index], { radius } = this.viewer.frames[index], { regions, surface, regionOfTriangle } = model.thin;
    const { face: id, area, place, opposite } = regions[number], ends = [place, opposite].map((end) => subtract(end, model.origin));
    const span = subtract(ends[0], ends[1]), thickness = Math.hypot(...span), face = model.faceOfId(id);
    const normal = face < 0 ? [0, 0, 1] : Array.from(model.normals.subarray(4 * face, 4 * face + 3));
    const outward = thickness > 1e-6 * radius ? scaled(span, 1 / thickness) : unit(normal, [0, 0, 1]);
    const { toViewer } = this.viewer.axesOf(index, this.viewer.state), point = scaled(add(...ends), 0.5);
    const direction = directionOfLeastCover(model, ends, outward, toViewer, 1e-4 * radius);
    const extent = (surface && regionRadius(surface, regionOfTriangle, number, point)) || Math.sqrt(area);
    const seen = Math.max(1.3 * Math.min(extent, radius / 2), 8 * thickness, radius / 40);
    this.fly(index, point, Math.max(radius / seen, this.viewer.initial.zoom), direction);
    this.viewer.store.set({
      face: `${index}:${id}`, show: this.showing(index), thin: true, thinAt: null, part: null,
      rest: this.viewer.state.rest === 'grey' ? 'glass' : this.viewer.state.rest,
    });
  }

  part(index, part) {
    const model = this.viewer.models[index], { centre } = this.viewer.frames[index];
    const point = subtract(part.centre, model.origin), outwards = subtract(point, centre);
    const length = Math.hypot(...outwards);
    this.fly(index, point, this.zoomFor(index, part.area), length > 0 ? scaled(outwards, 1 / length) : null);
    this.viewer.store.set({ part: `${index}:${part.label}`, thin: false, layer: this.viewer.layers.has('segment') ? 'segment' : this.viewer.state.layer, show: this.showing(index) });
  }

  // The value of `show` with which the mesh is visible.
  showing(index) {
    return this.viewer.look.panes.some((pane) => pane.index === index) ? this.viewer.state.show : String(index);
  }
}
