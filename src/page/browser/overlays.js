// Elements over the view: names of the panes, rings at thin places and at the selected face, a scale.
import { formatValue } from './format.js';
import { markedRegions, regionValue } from './thin_places.js';
import { subtract } from './vectors.js';

const kTextWidth = 60, kTextHeight = 17;  // Greatest size of the text at a marker, in pixels.

/** The scale {value, pixels, label}: the longest round length that fits a third of the width of the pane. */
export function scaleOf(camera) {
  const most = camera.width / 3 * camera.pixelSize, power = 10 ** Math.floor(Math.log10(most));
  const value = Math.max(...[1, 2, 5].map((step) => step * power).filter((length) => length <= most));
  return { value, pixels: value / camera.pixelSize, label: formatValue(value) };
}

/** Pixel of the canvas at a point of a pane; null outside of the pane. */
function canvasPixel(pane, point) {
  const [x, y] = pane.camera.pixelOf(point);
  const isInside = x >= 0 && y >= 0 && x <= pane.width && y <= pane.height;
  return isInside ? [pane.left + x, pane.top + y] : null;
}

/** Pixel of the canvas at the selected face of a pane, or null. */
export function ringOf(pane) {
  if (!pane.outline) return null;
  const [a, b, c] = pane.outline;
  return canvasPixel(pane, a.map((value, axis) => (value + b[axis] + c[axis]) / 3));
}

// Markers {x, y, text, isLeft} at the thinnest places of the regions in a pane. No text covers another one.
export function markersOf(pane, viewer) {
  if (!viewer.thin?.isGiven) return [];
  const model = viewer.models[pane.index], markers = [];
  for (const region of markedRegions(model)) {
    const at = canvasPixel(pane, subtract(region.place, model.origin));
    if (!at) continue;
    const [x, y] = at.map(Math.round);
    const isFree = markers.every((other) => Math.abs(other.y - y) > kTextHeight || Math.abs(other.x - x) > kTextWidth);
    markers.push({ x, y, text: isFree ? regionValue(region, model.thin.limit) : '', isLeft: x > pane.left + pane.width - kTextWidth });
  }
  return markers;
}

export class Overlays {
  constructor(viewer, folder) {
    Object.assign(this, { viewer, folder });
    viewer.afterFrame.push((panes) => this.update(panes));
  }

  add(id, className, x, y, text = '') {
    const element = Object.assign(document.createElement('div'), { id, className, textContent: text });
    Object.assign(element.style, { left: `${x}px`, top: `${y}px` });
    this.folder.append(element);
    return element;
  }

  update(panes) {
    // Elements are replaced only if something differs, because each change repaints them.
    const all = panes.map((pane) => ({
      pane, scale: scaleOf(pane.camera), ring: ringOf(pane), markers: markersOf(pane, this.viewer),
    }));
    const key = JSON.stringify(all.map(({ pane, ...rest }) => [pane.index, pane.left, pane.top, pane.height, rest]));
    if (this.shown === key) return;
    this.shown = key;
    this.folder.replaceChildren();
    all.forEach(({ pane, scale, ring, markers }, i) => {
      const { models } = this.viewer;
      if (models.length > 1) this.add(`pane-title-${i}`, 'pane-title', pane.left + 8, pane.top + 6, models[pane.index].description.label);
      this.add(`scale-${i}`, 'scale', pane.left + 10, pane.top + pane.height - 28, scale.label).style.width = `${scale.pixels}px`;
      markers.forEach(({ x, y, text, isLeft }, k) => this.add(`marker-${i}-${k}`, isLeft ? 'marker left' : 'marker', x - 9, y - 9, text));
      if (ring) this.add(`ring-${i}`, 'ring', ring[0] - 9, ring[1] - 9);
    });
  }
}
