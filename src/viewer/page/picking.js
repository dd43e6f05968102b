// Intersection of a ray with all triangles: exact for any zoom, without reading back from the graphics card.
import { dot } from './vectors.js';

/**
 * The visible face nearest to the viewer on the line through `point` towards the viewer, and the point on it; or null.
 * colours: alpha 0 is invisible; plane: [x, y, z, w] is visible where positive, or null; facing: 1 excludes back faces.
 */
export function pickFace(model, colours, point, toViewer, plane, facing) {
  const { positions, indices } = model;
  const [dx, dy, dz] = toViewer;
  let best = -Infinity, found = -1;
  for (let i = 0, face = 0; i < indices.length; i += 3, ++face) {
    const a = 3 * indices[i], b = 3 * indices[i + 1], c = 3 * indices[i + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ux = positions[b] - ax, uy = positions[b + 1] - ay, uz = positions[b + 2] - az;
    const vx = positions[c] - ax, vy = positions[c + 1] - ay, vz = positions[c + 2] - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0 || (facing && determinant < 0)) continue;
    const tx = point[0] - ax, ty = point[1] - ay, tz = point[2] - az;
    const s = (tx * px + ty * py + tz * pz) / determinant;
    if (s < 0 || s > 1) continue;
    const qx = ty * uz - tz * uy, qy = tz * ux - tx * uz, qz = tx * uy - ty * ux;
    const t = (dx * qx + dy * qy + dz * qz) / determinant;
    if (t < 0 || s + t > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    if (distance <= best || colours[face] >>> 24 === 0) continue;
    if (plane && dot(plane, [0, 1, 2].map((k) => point[k] + distance * toViewer[k])) + plane[3] < 0) continue;
    best = distance;
    found = face;
  }
  return found < 0 ? null : { face: found, point: [0, 1, 2].map((k) => point[k] + best * toViewer[k]) };
}
