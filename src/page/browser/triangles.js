
const kNoFace = 0xffffffff;

export class Triangles {
  constructor(positions, indices) {
    Object.assign(this, { positions, indices, faceCount: indices.length / 3 });
    this.measure();
  }

  corner(face, corner) {
    const at = 3 * this.indices[3 * face + corner];
    return [this.positions[at], this.positions[at + 1], this.positions[at + 2]];
  }

  centreOf(face) {
    const [a, b, c] = [0, 1, 2].map((corner) => this.corner(face, corner));
    return a.map((value, axis) => (value + b[axis] + c[axis]) / 3);
  }

  // Computes the areas, and the normals as signed bytes.
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

  // Vertices and triangles for flat attributes. Vertex k is the provoking corner of face k, and has the attributes of
  // face k. isFirst: the provoking corner is the first one, else the last. sources: the copied vertex for each vertex.
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

  /** Area-weighted normals of the vertices, as signed bytes. */
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

  /** Each edge once. ends: two vertices per edge. faces: the first two faces of each edge; kNoFace: none. */
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

  /** Two vertices per edge whose faces have normals with a smaller cosine than `most`, or that has only one face. */
  creases(most) {
    const { ends, faces } = this.edges(), { normals } = this, least = most * 127 * 127;
    const isCrease = (a, b) => b === kNoFace
      || normals[4 * a] * normals[4 * b] + normals[4 * a + 1] * normals[4 * b + 1] + normals[4 * a + 2] * normals[4 * b + 2] < least;
    return ends.filter((_, i) => isCrease(faces[i & ~1], faces[i | 1]));
  }

  // A copy with about `count` triangles, by vertex clustering (Rossignac and Borrel 1993): the vertices in a cell of a
  // grid become one vertex, and triangles with two corners in one cell vanish. sourceFaces: the original faces.
  reduced(count) {
    const { positions, indices } = this, vertexCount = positions.length / 3;
    const farthest = positions.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    const cell = Math.max(Math.sqrt(2 * this.totalArea / count), farthest / 65535) || 1;  // A key has 17 bits per axis.
    const cells = new Map(), cellOf = new Uint32Array(vertexCount), firsts = [];
    const at = (i) => Math.round(positions[i] / cell);
    for (let vertex = 0, i = 0; vertex < vertexCount; ++vertex, i += 3) {
      const key = (at(i) * 131072 + at(i + 1)) * 131072 + at(i + 2);
      let number = cells.get(key);
      if (number === undefined) cells.set(key, number = firsts.push(vertex) - 1);
      cellOf[vertex] = number;
    }
    const corners = [], sourceFaces = [], found = new Set(), cellCount = firsts.length;
    for (let face = 0, i = 0; i < indices.length; ++face, i += 3) {
      let a = cellOf[indices[i]], b = cellOf[indices[i + 1]], c = cellOf[indices[i + 2]];
      if (a === b || b === c || c === a) continue;
      while (a > b || a > c) [a, b, c] = [b, c, a];
      const key = (a * cellCount + b) * cellCount + c;
      if (found.has(key)) continue;
      found.add(key);
      corners.push(a, b, c);
      sourceFaces.push(face);
    }
    const places = new Float32Array(3 * cellCount);
    firsts.forEach((vertex, i) => places.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
    return Object.assign(new Triangles(places, Uint32Array.from(corners)), { sourceFaces });
  }
}
