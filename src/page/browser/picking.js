// Intersects lines with all triangles: exact at any zoom, unlike pixels that are read back from the graphics card.
import { add, dot, scaled } from './vectors.js';

/** Calls visit(face, distance, facing) for each triangle that the line hits. facing: positive if the front is hit. */
function forEachHit(model, point, direction, visit) {
  const { positions, indices } = model;
  const [dx, dy, dz] = direction, [ox, oy, oz] = point;
  for (let i = 0, face = 0; i < indices.length; i += 3, ++face) {
    const a = 3 * indices[i], b = 3 * indices[i + 1], c = 3 * indices[i + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ux = positions[b] - ax, uy = positions[b + 1] - ay, uz = positions[b + 2] - az;
    const vx = positions[c] - ax, vy = positions[c + 1] - ay, vz = positions[c + 2] - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const tx = ox - ax, ty = oy - ay, tz = oz - az;
    const s = (tx * px + ty * py + tz * pz) / determinant;
    if (s < 0 || s > 1) continue;
    const qx = ty * uz - tz * uy, qy = tz * ux - tx * uz, qz = tx * uy - ty * ux;
    const t = (dx * qx + dy * qy + dz * qz) / determinant;
    if (t >= 0 && s + t <= 1) visit(face, (vx * qx + vy * qy + vz * qz) / determinant, determinant);
  }
}

// The visible face {face, point} nearest to the viewer on the line through `point`; null if there is none. colours (or
// null): faces with alpha 0 are invisible. plane (or null): [x, y, z, w]; its negative side is invisible. facing: if
// true, back faces are invisible.
export function pickFace(model, colours, point, toViewer, plane, facing) {
  let best = -Infinity, found = -1;
  const at = (distance) => add(point, scaled(toViewer, distance));
  forEachHit(model, point, toViewer, (face, distance, front) => {
    if (distance <= best || (facing && front < 0) || (colours && colours[face] >>> 24 === 0)) return;
    if (plane && dot(plane, at(distance)) + plane[3] < 0) return;
    best = distance;
    found = face;
  });
  return found < 0 ? null : { face: found, point: at(best) };
}

/** Number of faces that a ray hits at a distance above `least`. direction: a unit vector. */
export function countHits(model, point, direction, least) {
  let count = 0;
  forEachHit(model, point, direction, (_, distance) => count += Number(distance > least));
  return count;
}
