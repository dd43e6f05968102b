// A decoded mesh with what is derived from its triangles. Arrays per face are in the order of the page, not of the file.
import { kLabelColours } from './colour_maps.js';

const kNoFace = 0xffffffff;

export class MeshModel {
  constructor(description, origin, decoded) {
    Object.assign(this, decoded);  // positions, indices, faceIds, fields
    this.description = description;
    this.origin = origin;  // Positions are relative to it.
    this.faceCount = this.indices.length / 3;
    this.boxMin = description.boxMin.map((value, axis) => value - this.origin[axis]);
    this.boxMax = description.boxMax.map((value, axis) => value - this.origin[axis]);
    this.measure();
  }

  fieldNamed(name) {
    return this.description.fields.find((field) => field.name === name);
  }

  faceOfId(id) {
    return this.faceIds.indexOf(id);
  }

  corner(face, corner) {
    const at = 3 * this.indices[3 * face + corner];
    return [this.positions[at], this.positions[at + 1], this.positions[at + 2]];
  }

  centreOf(face) {
    const [a, b, c] = [0, 1, 2].map((corner) => this.corner(face, corner));
    return a.map((value, axis) => (value + b[axis] + c[axis]) / 3);
  }

  // Areas, and normals as signed bytes.
  measure() {
    const { positions, indices, faceCount } = this;
    this.areas = new Float32Array(faceCount);
    this.normals = new Int8Array(4 * faceCount);
    let total = 0;
    for (let face = 0, i = 0; face < faceCount; ++face, i += 3) {
      const a = 3 * indices[i], b = 3 * indices[i + 1], c = 3 * indices[i + 2];
      const ux = positions[b] - positions[a], vx = positions[c] - positions[a];
      const uy = positions[b + 1] - positions[a + 1], vy = positions[c + 1] - positions[a + 1];
      const uz = positions[b + 2] - positions[a + 2], vz = positions[c + 2] - positions[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      const length = Math.sqrt(x * x + y * y + z * z), scale = length > 0 ? 127 / length : 0;
      this.normals[4 * face] = x * scale;
      this.normals[4 * face + 1] = y * scale;
      this.normals[4 * face + 2] = z * scale;
      this.areas[face] = length / 2;
      total += length / 2;
    }
    this.totalArea = total;
  }

  /**
   * Vertices of which vertex k is a corner of face k, so that flat attributes of face k are attributes of vertex k, and
   * the triangles; k is their first corner or their last. sources: the vertex of the mesh that each is a copy of.
   */
  drawnVertices(isFirst) {
    const { positions, indices, faceCount } = this;
    const copyOf = new Uint32Array(positions.length / 3).fill(kNoFace);
    const own = new Uint8Array(faceCount);
    const sources = [];
    const rest = new Uint32Array(faceCount);
    for (let face = 0; face < faceCount; ++face) {
      let corner = 0;
      while (corner < 3 && copyOf[indices[3 * face + corner]] !== kNoFace) ++corner;
      own[face] = corner %= 3;
      rest[face] = indices[3 * face + corner];
      if (copyOf[rest[face]] === kNoFace) copyOf[rest[face]] = face;
    }
    const triangles = new Uint32Array(3 * faceCount);
    const drawn = (vertex) => {
      if (copyOf[vertex] === kNoFace) copyOf[vertex] = faceCount + sources.push(vertex) - 1;
      return copyOf[vertex];
    };
    for (let face = 0, i = 0; face < faceCount; ++face, i += 3) {
      const next = drawn(indices[i + (own[face] + 1) % 3]), last = drawn(indices[i + (own[face] + 2) % 3]);
      triangles[i] = isFirst ? face : next;
      triangles[i + 1] = isFirst ? next : last;
      triangles[i + 2] = isFirst ? last : face;
    }
    const all = new Uint32Array(faceCount + sources.length);
    all.set(rest);
    all.set(sources, faceCount);
    const places = new Float32Array(3 * all.length);
    for (let i = 0, to = 0; i < all.length; ++i) {
      let from = 3 * all[i];
      places[to++] = positions[from++];
      places[to++] = positions[from++];
      places[to++] = positions[from];
    }
    return { sources: all, positions: places, triangles };
  }

  /** Normals of vertices, weighted by area, as signed bytes. */
  smoothNormals() {
    const { positions, indices, faceCount, normals, areas } = this;
    const sums = new Float32Array(positions.length);
    for (let face = 0; face < faceCount; ++face)
      for (let corner = 0; corner < 3; ++corner)
        for (let axis = 0; axis < 3; ++axis)
          sums[3 * indices[3 * face + corner] + axis] += normals[4 * face + axis] * areas[face];
    const bytes = new Int8Array(positions.length / 3 * 4);
    for (let from = 0, to = 0; from < sums.length; from += 3, to += 4) {
      const scale = 127 / (Math.hypot(sums[from], sums[from + 1], sums[from + 2]) || 1);
      for (let axis = 0; axis < 3; ++axis) bytes[to + axis] = sums[from + axis] * scale;
    }
    return bytes;
  }

  /** Pairs of vertices, each edge once, and the first two faces at each (kNoFace: none). */
  edges() {
    if (this.cachedEdges) return this.cachedEdges;
    const { indices } = this;
    const size = 2 ** Math.ceil(Math.log2(2 * indices.length + 2));
    const slots = new Int32Array(size).fill(-1);
    const ends = new Uint32Array(2 * indices.length), faces = new Uint32Array(2 * indices.length);
    let count = 0;
    for (let i = 0; i < indices.length; ++i) {
      const from = indices[i], to = indices[i % 3 === 2 ? i - 2 : i + 1];
      const low = Math.min(from, to), high = Math.max(from, to);
      let slot = (Math.imul(low, 0x9e3779b1) ^ Math.imul(high, 0x85ebca6b)) >>> 3 & size - 1;
      while (slots[slot] >= 0 && (ends[2 * slots[slot]] !== low || ends[2 * slots[slot] + 1] !== high))
        slot = slot + 1 & size - 1;
      const edge = slots[slot];
      if (edge >= 0) {
        if (faces[2 * edge + 1] === kNoFace) faces[2 * edge + 1] = Math.floor(i / 3);
        continue;
      }
      slots[slot] = count;
      ends[2 * count] = low;
      ends[2 * count + 1] = high;
      faces[2 * count] = Math.floor(i / 3);
      faces[2 * count++ + 1] = kNoFace;
    }
    return this.cachedEdges = { ends: ends.slice(0, 2 * count), faces: faces.slice(0, 2 * count) };
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
