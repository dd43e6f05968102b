// A decoded mesh: triangles and fields. Arrays per face are in the order of the page; faceIds: numbers in the file.
import { isCounted } from './thin_places.js';
import { Triangles } from './triangles.js';

export class MeshModel extends Triangles {
  /** thinSurface: the decoded surface that is thinner than the limit; null if there is none. */
  constructor(description, origin, decoded, thinSurface) {
    super(decoded.positions, decoded.indices);
    Object.assign(this, { description, origin, faceIds: decoded.faceIds, fields: decoded.fields });
    // The box is relative to the origin, like the positions.
    this.boxMin = description.boxMin.map((value, axis) => value - origin[axis]);
    this.boxMax = description.boxMax.map((value, axis) => value - origin[axis]);
    if (!description.thin) return;
    const { positions = [], indices = [], fields } = thinSurface ?? {};
    this.thin = { ...description.thin, surface: new Triangles(positions, indices), regionOfTriangle: fields?.get('region') };
    const { surface, regionOfTriangle, regions } = this.thin;
    this.thin.area = surface.areas.reduce((sum, area, face) => sum + (isCounted(this.thin, regions[regionOfTriangle[face]] ?? {}) ? area : 0), 0);
  }

  faceOfId(id) {
    return this.faceIds.indexOf(id);
  }

  /** Pairs of label and area of a field of labels, by descending area. */
  labelAreas(values) {
    const areas = new Map();
    for (let face = 0; face < this.faceCount; ++face)
      if (!Number.isNaN(values[face])) areas.set(values[face], (areas.get(values[face]) ?? 0) + this.areas[face]);
    return [...areas].sort((a, b) => b[1] - a[1]);
  }
}
