// Vectors are arrays of three numbers.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** The unit vector of `a`; returns `otherwise` if the length of `a` is zero. */
export function unit(a, otherwise) {
  const length = Math.hypot(...a);
  return length > 0 ? scaled(a, 1 / length) : otherwise;
}
