// A decoded mesh: its triangles, fields and labels. Arrays per face are in the order of the page, not of the file.
import { kLabelColours } from './colour_maps.js';
import { Triangles } from './triangles.js';

export class MeshModel extends Triangles {
  /** thinSurface: the decoded surface that is thinner than the limit, or null where there is none. */
  constructor(description, origin, decoded, thinSurface) {
    super(decoded.positions, decoded.indices);
    Object.assign(this, { description, origin, faceIds: decoded.faceIds, fields: decoded.fields });
    // Relative to the origin, as the positions are.
    this.boxMin = description.boxMin.map((value, axis) => value - origin[axis]);
    this.boxMax = description.boxMax.map((value, axis) => value - origin[axis]);
    if (!description.thin) return;
    const { positions = [], indices = [], fields } = thinSurface ?? {};
    this.thin = { ...description.thin, surface: new Triangles(positions, indices), regionOfTriangle: fields?.get('region') };
  }

  faceOfId(id) {
    return this.faceIds.indexOf(id);
  }

  /** Areas of labels, largest first, of a field of labels. */
  labelAreas(values) {
    const areas = new Map();
    for (let face = 0; face < this.faceCount; ++face)
      if (!Number.isNaN(values[face])) areas.set(values[face], (areas.get(values[face]) ?? 0) + this.areas[face]);
    return [...areas].sort((a, b) => b[1] - a[1]);
  }

  /**
   * Packed colour of each label: labels that share an edge differ unless one has neighbours of all colours. Greedy, the
   * largest label first; each gets the colour that its neighbours have least, of those the one that is used least.
   */
  labelColours(values) {
    const { faces } = this.edges();
    const neighbours = new Map();
    for (let i = 0; i < faces.length; i += 2) {
      const a = values[faces[i]], b = values[faces[i + 1]];
      if (!(a !== b && a >= 0 && b >= 0)) continue;
      for (const [one, other] of [[a, b], [b, a]]) {
        if (!neighbours.has(one)) neighbours.set(one, new Set());
        neighbours.get(one).add(other);
      }
    }
    const chosen = new Map(), useCounts = kLabelColours.map(() => 0);
    for (const [label] of this.labelAreas(values)) {
      const near = kLabelColours.map(() => 0);
      for (const other of neighbours.get(label) ?? []) if (chosen.has(other)) ++near[chosen.get(other)];
      let best = 0;
      for (let colour = 1; colour < near.length; ++colour)
        if (near[colour] < near[best] || (near[colour] === near[best] && useCounts[colour] < useCounts[best]))
          best = colour;
      chosen.set(label, best);
      ++useCounts[best];
    }
    return new Map([...chosen].map(([label, colour]) => [label, kLabelColours[colour]]));
  }
}
