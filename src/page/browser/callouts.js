// Numbered callouts of a pane: a ring at each place, a label in a column at the left or the right side of the mesh, and
// a line between both. The list of places has the same numbers.
import { boxCorners } from './camera.js';
import { markedPlaces, regionValue } from './thin_places.js';
import { add, subtract } from './vectors.js';

const kRow = 30, kEdgePixels = 8, kGap = 26, kLabel = 92;
/** Panes that are narrower have labels without values. */
const kNarrowWidth = 520;

export const isNarrow = (pane) => pane.width < kNarrowWidth;

/** Radius of the rings. */
export const ringRadius = (pane) => isNarrow(pane) ? 6 : 9;

/** Width of the columns of labels at both sides of a pane. */
export const columnWidth = (pane) => isNarrow(pane) ? 36 : kLabel + kGap + kEdgePixels;

/** Pixel of the canvas at a point of a pane; null outside of the pane. */
export function canvasPixel(pane, point) {
  const [x, y] = pane.camera.pixelOf(point);
  const isInside = x >= 0 && y >= 0 && x <= pane.width && y <= pane.height;
  return isInside ? [pane.left + x, pane.top + y] : null;
}

// Pixels of the left and the right end of the mesh in a pane.
function sidesOf(pane) {
  const { camera } = pane;
  const across = boxCorners(camera.frame.size).map((corner) => camera.pixelOf(add(camera.frame.centre, corner))[0]);
  return [Math.min(...across), Math.max(...across)];
}

// Rows in a column: at least kRow apart, as close to the wanted rows as one pass down and one pass up allow.
function spread(callouts, low, high) {
  callouts.sort((a, b) => a.y - b.y);
  let row = low;
  for (const callout of callouts) row = (callout.row = Math.max(callout.y, row)) + kRow;
  row = high;
  for (const callout of callouts.toReversed()) row = (callout.row = Math.min(callout.row, row)) - kRow;
}

// Callouts {index, number, text, x, y, isLeft, column, row} of a pane. (x, y): the place. (column, row): the end of the
// label that is next to the place.
export function calloutsOf(pane, viewer) {
  if (!viewer.showsPlaces()) return [];
  const model = viewer.models[pane.index], [low, high] = sidesOf(pane), isShort = isNarrow(pane);
  const callouts = markedPlaces(model).flatMap(({ region, index }, i) => {
    const at = canvasPixel(pane, subtract(region.place, model.origin));
    if (!at) return [];
    const text = isShort ? '' : regionValue(region, model.thin?.limit);
    return [{ index, number: i + 1, text, x: Math.round(at[0]), y: Math.round(at[1]) }];
  });
  const middle = pane.left + pane.width / 2, width = isShort ? 24 : kLabel;
  for (const callout of callouts) callout.isLeft = callout.x < middle;
  for (const isLeft of [true, false]) {
    const some = callouts.filter((callout) => callout.isLeft === isLeft);
    const column = Math.round(isLeft ? Math.max(pane.left + low - kGap, pane.left + kEdgePixels + width)
      : Math.min(pane.left + high + kGap, pane.left + pane.width - kEdgePixels - width));
    for (const callout of some) callout.column = column;
    spread(some, pane.top + 30, pane.top + pane.height - (isLeft ? 50 : 30 + viewer.insetHeight));
  }
  return callouts;
}

/** The two ends of the wall at the selected place, in pixels; null if they are too close to each other. */
export function dimensionOf(pane, viewer) {
  const place = viewer.selectedPlace(pane.index);
  if (!place || !viewer.showsPlaces()) return null;
  const { region } = place, model = viewer.models[pane.index];
  const ends = [region.place, region.opposite].map((end) => canvasPixel(pane, subtract(end, model.origin)));
  return ends.includes(null) || Math.hypot(ends[0][0] - ends[1][0], ends[0][1] - ends[1][1]) < 8 ? null : ends;
}
