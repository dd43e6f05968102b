// A small picture of the whole mesh in a corner of the view, while the view shows only a part of it.
import { PaneCamera } from './camera.js';

const kFirstZoom = 1.6;  // Relative to the zoom that shows all.
const kShare = 0.24, kMostPixels = 180, kCornerMargin = 12;

/** The pane of the inset for a pane of the view. background: three numbers. */
export function insetOf(pane, state, axes, background) {
  const side = Math.round(Math.min(kMostPixels, kShare * Math.max(pane.width, pane.height), 0.5 * Math.min(pane.width, pane.height)));
  const camera = new PaneCamera({ ...state, x: 0, y: 0, z: 0, zoom: 0.95 }, axes, pane.camera.frame, side, side);
  return {
    ...pane, left: pane.left + pane.width - side - kCornerMargin, top: pane.top + pane.height - side - kCornerMargin, width: side, height: side,
    camera, background, isInset: true, seen: pane, outline: null,
  };
}

export const needsInset = (zoom, whole) => zoom > kFirstZoom * whole;
