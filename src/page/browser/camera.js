// Camera with parallel projection that turns around an upright axis. Azimuth 0 and elevation 0: view of the broad side.
import { add, clamp, cross, dot, scaled, subtract } from './vectors.js';

export const kViews = {
  corner: [30, 18], front: [0, 0], right: [90, 0], back: [180, 0], left: [-90, 0], top: [0, 90], bottom: [0, -90],
};

const kRadians = Math.PI / 180;
const axisVector = (axis, sign) => [0, 1, 2].map((i) => i === axis ? sign : 0);

/** The directions up, front (azimuth 0) and side (azimuth 90). boxSize: sides of the box of the mesh. */
export function uprightFrame(up, boxSize) {
  const axis = 'xyz'.indexOf(up.at(-1)), upward = axisVector(axis, up.length > 1 ? -1 : 1);
  // The front is the shorter horizontal axis. If both are equal, the front is -y if z is up, else z.
  const usual = axis === 2 ? 1 : 2, other = axis === 0 ? 1 : 0;
  const isBroadside = boxSize[other] >= boxSize[usual];
  const front = axisVector(isBroadside ? usual : other, isBroadside && axis === 2 ? -1 : 1);
  return { up: upward, front, side: cross(upward, front) };
}

/** Orthonormal axes of the view: right, up, toViewer. upright: the directions side, up, front. state: {up, az, el}. */
export function viewAxes(state, boxSize) {
  const { up, front, side } = uprightFrame(state.up, boxSize);
  const az = state.az * kRadians, el = state.el * kRadians;
  const level = add(scaled(front, Math.cos(az)), scaled(side, Math.sin(az)));
  const toViewer = add(scaled(level, Math.cos(el)), scaled(up, Math.sin(el)));
  const right = subtract(scaled(side, Math.cos(az)), scaled(front, Math.sin(az)));
  return { right, up: cross(toViewer, right), toViewer, upright: [side, up, front] };
}

/** Azimuth and elevation of a view in which `direction` points to the viewer. */
export function anglesTowards(direction, { upright: [side, up, front] }) {
  return {
    az: Math.atan2(dot(direction, side), dot(direction, front)) / kRadians,
    el: Math.asin(clamp(dot(direction, up), -1, 1)) / kRadians,
  };
}

/** Corners of a box that is centred at the origin. */
export function boxCorners(size) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => size.map((length, axis) => (i >> axis & 1 ? 0.5 : -0.5) * length));
}

// Camera of a pane, which shows a mesh within a frame {centre, radius, size}. The target is the centre of the pane. The
// state has the offset of the target from the centre of the frame along side (x), up (y) and front (z), in radii of the
// frame. With zoom 1 a sphere with the radius of the frame fits the shorter side of the pane.
export class PaneCamera {
  constructor(state, axes, frame, width, height) {
    Object.assign(this, axes);
    this.width = width;
    this.height = height;
    this.frame = frame;
    this.target = [state.x, state.y, state.z].reduce(
      (sum, length, i) => add(sum, scaled(axes.upright[i], length * frame.radius)), frame.centre);
    this.pixelSize = 2 * frame.radius / ((state.zoom ?? 1) * Math.min(width, height));
    this.depth = 1 / (frame.radius * (2 + Math.hypot(state.x, state.y, state.z)));
  }

  /** The x, y and z of the state for which `point` is the target. */
  stateAt(point) {
    const offset = scaled(subtract(point, this.frame.centre), 1 / this.frame.radius);
    const [x, y, z] = this.upright.map((axis) => dot(offset, axis));
    return { x, y, z };
  }

  /** Matrix from positions to clip coordinates, column-major. */
  matrix() {
    const rows = [[this.right, 2 / (this.pixelSize * this.width)], [this.up, 2 / (this.pixelSize * this.height)],
      [this.toViewer, -this.depth]].map(([axis, factor]) => scaled(axis, factor));
    const columns = [0, 1, 2].flatMap((i) => [rows[0][i], rows[1][i], rows[2][i], 0]);
    return [...columns, ...rows.map((row) => -dot(row, this.target)), 1];
  }

  /** Matrix from directions to components along right, up and toViewer, column-major. */
  rotation() {
    return [0, 1, 2].flatMap((i) => [this.right[i], this.up[i], this.toViewer[i]]);
  }

  /** Pixel of a point, from the top left corner of the pane. */
  pixelOf(point) {
    const offset = subtract(point, this.target);
    return [this.width / 2 + dot(offset, this.right) / this.pixelSize,
      this.height / 2 - dot(offset, this.up) / this.pixelSize];
  }

  /** The point at a pixel, in the plane through the target that is perpendicular to the line of sight. */
  pointAt(x, y) {
    const across = scaled(this.right, (x - this.width / 2) * this.pixelSize);
    return add(this.target, add(across, scaled(this.up, (this.height / 2 - y) * this.pixelSize)));
  }
}

/** The frame {centre, size, radius} of each mesh. Meshes with similar boxes have a common frame. */
export function framesOf(models) {
  const frameOf = (low, high) => {
    const size = subtract(high, low);
    return { centre: scaled(add(low, high), 0.5), size, radius: Math.hypot(...size) / 2 || 1 };
  };
  const absolute = models.map(({ description }) => frameOf(description.boxMin, description.boxMax));
  const [first] = absolute;
  const areAlike = absolute.every((frame) => Math.hypot(...subtract(frame.centre, first.centre)) < 0.3 * first.radius
    && frame.radius < 2 * first.radius && first.radius < 2 * frame.radius);
  const end = (name, choose) => [0, 1, 2].map((axis) => choose(...models.map((model) => model.description[name][axis])));
  const common = frameOf(end('boxMin', Math.min), end('boxMax', Math.max));
  return models.map(({ origin }, i) => {
    const frame = areAlike ? common : absolute[i];
    return { ...frame, centre: subtract(frame.centre, origin) };
  });
}
