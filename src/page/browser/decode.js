// Decodes the arrays of a mesh, which src/page writes (docs/page-format.md).

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

function check(condition, name) {
  if (!condition) throw new Error(`wrong ${name}`);
}

/** Signed numbers from byte planes. The first plane has the lowest bytes of all numbers, the next plane the next bytes. */
function numbersOf(planes, count, name) {
  check(planes.length % count === 0 && planes.length <= 4 * count, `size of ${name}`);
  const numbers = new Int32Array(count);
  for (let begin = 0, shift = 0; begin < planes.length; begin += count, shift += 8)
    for (let i = 0; i < count; ++i) numbers[i] |= planes[begin + i] << shift;
  for (let i = 0; i < count; ++i) numbers[i] = (numbers[i] >>> 1) ^ -(numbers[i] & 1);
  return numbers;
}

/** Prefix sums modulo 2^32, in place. */
function summed(numbers) {
  for (let i = 1; i < numbers.length; ++i) numbers[i] += numbers[i - 1];
  return numbers;
}

/** Vertex indices of the corners. corners: 0 for a new vertex, else the index minus the count of preceding vertices. */
function indicesOf(corners, vertexCount) {
  const indices = new Uint32Array(corners.length);
  let count = 0;
  for (let i = 0; i < corners.length; ++i) {
    const corner = corners[i];
    check(corner <= 0 && corner >= -count, 'corners');
    indices[i] = count + corner;
    if (corner === 0) ++count;
  }
  check(count === vertexCount, 'corners');
  return indices;
}

function positionsOf(axes, { boxMin, step }, origin) {
  const positions = new Float32Array(3 * axes[0].length);
  axes.forEach((steps, axis) => {
    const low = boxMin[axis] - origin[axis];
    for (let i = 0; i < steps.length; ++i) positions[3 * i + axis] = low + steps[i] * step;
  });
  return positions;
}

const kNoLabel = -1, kDroppedBits = 9;

function valuesOf(kind, numbers) {
  if (kind === 'number') return new Float32Array(numbers.map((upperBits) => upperBits << kDroppedBits).buffer);
  const values = new Float32Array(numbers.length);
  for (let i = 0; i < values.length; ++i) values[i] = numbers[i] === kNoLabel ? NaN : numbers[i] >>> 0;
  return values;
}

// Decodes a mesh of the page. description: the entry of the mesh in "meshes". arrayBytes(number): returns the
// compressed bytes of an array. The result has positions relative to `origin`. Throws an Error if the data are damaged.
export async function decodeMesh(description, arrayBytes, origin = [0, 0, 0]) {
  const { arrays, fields, faceCount, vertexCount } = description;
  const load = async (number, count, name) => numbersOf(await inflate(arrayBytes(number)), count, name);
  const [corners, faceIds, x, y, z, ...values] = await Promise.all([
    load(arrays.corners, 3 * faceCount, 'corners'), load(arrays.faces, faceCount, 'faces'),
    ...['x', 'y', 'z'].map((axis) => load(arrays[axis], vertexCount, axis)),
    ...fields.map(({ array, name }) => load(array, faceCount, name))]);
  return {
    positions: positionsOf([x, y, z].map(summed), description, origin), indices: indicesOf(corners, vertexCount),
    faceIds: new Uint32Array(summed(faceIds).buffer),
    fields: new Map(fields.map(({ name, kind }, i) => [name, valuesOf(kind, summed(values[i]))])),
  };
}
