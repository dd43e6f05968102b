// Decodes the streams of a mesh. docs/page.md describes them; src/page writes them.

const noGate = 0xffffffff;
const symbolNew = 0, symbolNext = 1, symbolPrevious = 2, symbolBoth = 3, symbolGate = 4, symbolOld = 5,
      symbolClosed = 6, symbolStart = 7;
const gateOpen = 0, gateClosed = 1, gateRemoved = 2;

/** The bytes of base64 text. */
export function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers from planes of their bytes, as signed differences. */
function differencesOf(planes, count) {
  const differences = new Int32Array(count);
  for (let i = 0; i < count; ++i) differences[i] = planes[i];
  for (let begin = count, shift = 8; begin < planes.length; begin += count, shift += 8)
    for (let i = 0; i < count; ++i) differences[i] |= planes[begin + i] << shift;
  for (let i = 0; i < count; ++i) differences[i] = (differences[i] >>> 1) ^ -(differences[i] & 1);
  return differences;
}

/** Repeats the walk over the faces. fronts: three vertices per vertex; neighbours: two faces per face. */
function walkFaces(mesh, symbols, references) {
  const {faceCount, vertexCount, gateCount} = mesh;
  const indices = new Uint32Array(3 * faceCount);
  const neighbours = new Uint32Array(2 * faceCount);
  const fronts = new Uint32Array(3 * vertexCount).fill(noGate);
  const gateFace = new Uint32Array(gateCount), gateStart = new Uint32Array(gateCount),
        gateOpposite = new Uint32Array(gateCount), gatePrevious = new Uint32Array(gateCount),
        gateNext = new Uint32Array(gateCount), gateState = new Uint8Array(gateCount);
  const stack = new Uint32Array(gateCount + 1);
  let faces = 0, vertices = 0, gates = 0, stacked = 0, active = noGate, symbolAt = 0, referenceAt = 0;

  function reference() {
    let number = 0, shift = 0, byte;
    do {
      byte = references[referenceAt++];
      number |= (byte & 0x7f) << shift;
      shift += 7;
    } while (byte > 0x7f);
    return number >>> 0;
  }
  function addFace(a, b, c, first, second) {
    indices[3 * faces] = a;
    indices[3 * faces + 1] = b;
    indices[3 * faces + 2] = c;
    neighbours[2 * faces] = first;
    neighbours[2 * faces + 1] = second;
    return faces++;
  }
  function addGate(face, start, opposite) {
    gateFace[gates] = face;
    gateStart[gates] = start;
    gateOpposite[gates] = opposite;
    return gates++;
  }
  function link(gate, next) {
    gateNext[gate] = next;
    gatePrevious[next] = gate;
  }
  function pop() {
    active = noGate;
    while (active === noGate && stacked > 0)
      if (gateState[stack[--stacked]] === gateOpen) active = stack[stacked];
  }
  function startVertex() {
    const back = reference();
    return back === 0 ? vertices++ : vertices - back;
  }

  while (faces < faceCount) {
    const symbol = symbols[symbolAt >> 1] >> 4 * (symbolAt & 1) & 15;
    ++symbolAt;
    if (active === noGate) {
      const a = startVertex(), b = startVertex(), c = startVertex();
      const before = faces === 0 ? noGate : faces - 1;
      const face = addFace(a, b, c, before, before);
      if (symbol !== symbolStart) continue;
      const ab = addGate(face, a, c), bc = addGate(face, b, a), ca = addGate(face, c, b);
      link(ab, bc);
      link(bc, ca);
      link(ca, ab);
      stack[stacked++] = ca;
      stack[stacked++] = bc;
      active = ab;
      continue;
    }
    const gate = active;
    if (symbol === symbolClosed) {
      gateState[gate] = gateClosed;
      pop();
      continue;
    }
    const start = gateStart[gate], previous = gatePrevious[gate], next = gateNext[gate], end = gateStart[next],
          front = gateFace[gate];
    gateState[gate] = gateRemoved;
    if (symbol === symbolNext) {
      const beyond = gateNext[next], vertex = gateStart[beyond];
      const face = addFace(end, start, vertex, front, gateFace[next]);
      gateState[next] = gateRemoved;
      active = addGate(face, start, end);
      link(previous, active);
      link(active, beyond);
    } else if (symbol === symbolPrevious) {
      const vertex = gateStart[previous], before = gatePrevious[previous];
      const face = addFace(end, start, vertex, front, gateFace[previous]);
      gateState[previous] = gateRemoved;
      active = addGate(face, vertex, start);
      link(before, active);
      link(active, next);
    } else if (symbol === symbolBoth) {
      addFace(end, start, gateStart[previous], front, gateFace[next]);
      gateState[previous] = gateRemoved;
      gateState[next] = gateRemoved;
      link(gatePrevious[previous], gateNext[next]);
      pop();
    } else {
      let vertex, there = noGate;
      if (symbol === symbolNew) {
        vertex = vertices++;
        fronts[3 * vertex] = start;
        fronts[3 * vertex + 1] = end;
        fronts[3 * vertex + 2] = gateOpposite[gate];
      } else if (symbol === symbolGate) {
        there = gates - reference();
        vertex = gateStart[there];
      } else if (symbol === symbolOld) {
        vertex = vertices - reference();
      } else {
        throw new Error('The data of the mesh is damaged.');
      }
      const face = addFace(end, start, vertex, front, front);
      const first = addGate(face, start, end), second = addGate(face, vertex, start);
      if (there === noGate) {
        link(first, second);
      } else {
        link(gatePrevious[there], second);
        link(first, there);
      }
      link(previous, first);
      link(second, next);
      stack[stacked++] = first;
      active = second;
    }
  }
  return {indices, neighbours, fronts};
}

/** Adds coordinates of one axis to positions. */
function decodeCoordinates(planes, mesh, fronts, axis, origin, positions) {
  const count = mesh.vertexCount, differences = differencesOf(planes, count), steps = new Uint16Array(count);
  const low = mesh.boxMin[axis] - origin[axis];
  for (let i = 0; i < count; ++i) {
    const start = fronts[3 * i];
    let predicted = i === 0 ? 0 : steps[i - 1];
    if (start !== noGate) predicted = steps[start] + steps[fronts[3 * i + 1]] - steps[fronts[3 * i + 2]];
    steps[i] = predicted + differences[i];
    positions[3 * i + axis] = low + steps[i] * mesh.step;
  }
}

function decodeFaceIds(planes, neighbours, count) {
  const differences = differencesOf(planes, count), ids = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const neighbour = neighbours[2 * i];
    ids[i] = (neighbour === noGate ? 0 : ids[neighbour]) + differences[i];
  }
  return ids;
}

function bitOf(bits, i) {
  return bits[i >> 3] >> (i & 7) & 1;
}

/** Sets the values of marked faces. */
function applyMarks(values, bits, value) {
  for (let i = 0; i < values.length; ++i)
    if (bitOf(bits, i)) values[i] = value;
}

function decodeField(field, planes, neighbours, count) {
  const values = new Float32Array(count);
  if (field.kind === 'flag') {
    for (let i = 0; i < count; ++i) values[i] = bitOf(planes, i);
    return values;
  }
  const codes = differencesOf(planes, count), isNumber = field.kind === 'number';
  for (let i = 0; i < count; ++i) {
    const first = neighbours[2 * i];
    if (first === noGate) continue;
    codes[i] += isNumber ? codes[first] + codes[neighbours[2 * i + 1]] >> 1 : codes[first];
  }
  if (!isNumber) {
    for (let i = 0; i < count; ++i) values[i] = codes[i] >>> 0;
    return values;
  }
  const powers = [];
  for (let i = 0; i < count; ++i) {
    const code = codes[i], size = (code < 0 ? -code : code) - 1;
    if (size < 0) continue;
    const decade = size / 9000 | 0;
    powers[decade] ??= Number('1e' + (field.lowestExponent + decade));
    const value = (size - 9000 * decade + 1000) * powers[decade];
    values[i] = code < 0 ? -value : value;
  }
  return values;
}

/**
 * Decodes a mesh of the page. description: its entry of "meshes"; streamBytes(number): the compressed bytes of a
 * stream, or a promise of them. Positions are relative to `origin`.
 */
export async function decodeMesh(description, streamBytes, origin = [0, 0, 0]) {
  const load = async (number) => inflate(await streamBytes(number));
  const {streams, fields, faceCount, vertexCount} = description;
  const loading = ['symbols', 'references', 'x', 'y', 'z', 'faces'].map((key) => load(streams[key]));
  const loadingFields = fields.map((field) => Promise.all(
      ['stream', 'missing', 'zero'].map((key) => field[key] === undefined ? null : load(field[key]))));
  const [symbols, references, x, y, z, faces] = await Promise.all(loading);
  const {indices, neighbours, fronts} = walkFaces(description, symbols, references);
  const positions = new Float32Array(3 * vertexCount);
  [x, y, z].forEach((planes, axis) => decodeCoordinates(planes, description, fronts, axis, origin, positions));
  const result = {positions, indices, faceIds: decodeFaceIds(faces, neighbours, faceCount), fields: new Map()};
  for (let i = 0; i < fields.length; ++i) {
    const [planes, missing, zero] = await loadingFields[i];
    const values = decodeField(fields[i], planes, neighbours, faceCount);
    if (zero) applyMarks(values, zero, 0);
    if (missing) applyMarks(values, missing, NaN);
    result.fields.set(fields[i].name, values);
  }
  return result;
}
