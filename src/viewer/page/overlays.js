// What lies over the view: names of the panes, a ring at the selected face, a scale.
import { formatValue } from './format.js';

/** The longest round length that takes at most a third of the pane: {value, pixels}. */
export function scaleOf(camera) {
  const most = camera.width / 3 * camera.pixelSize, power = 10 ** Math.floor(Math.log10(most));
  const value = Math.max(...[1, 2, 5].map((step) => step * power).filter((length) => length <= most));
  return { value, pixels: value / camera.pixelSize, label: formatValue(value) };
}

/** Pixel of the canvas at which the selected face of a pane is, or null. */
export function ringOf(pane) {
  if (!pane.outline) return null;
  const [a, b, c] = pane.outline;
  const [x, y] = pane.camera.pixelOf(a.map((value, axis) => (value + b[axis] + c[axis]) / 3));
  const isInside = x >= 0 && y >= 0 && x <= pane.width && y <= pane.height;
  return isInside ? [pane.left + x, pane.top + y] : null;
}

export class Overlays {
  constructor(viewer, folder) {
    this.folder = folder;
    this.viewer = viewer;
    viewer.afterFrame.push((panes) => this.update(panes));
  }

  element(i, kind, tag = 'div') {
    const id = `${kind}-${i}`, found = document.getElementById(id);
    if (found) return found;
    const made = Object.assign(document.createElement(tag), { id, className: kind });
    this.folder.append(made);
    return made;
  }

  update(panes) {
    // Unchanged elements are left alone: each change is painted anew.
    const key = JSON.stringify(panes.map((pane) => [pane.index, pane.left, pane.top, scaleOf(pane.camera), ringOf(pane)]));
    if (this.shown === key) return;
    this.shown = key;
    const place = (element, x, y) => Object.assign(element.style, { left: `${x}px`, top: `${y}px` });
    while (this.folder.childElementCount > 3 * panes.length) this.folder.lastChild.remove();
    panes.forEach((pane, i) => {
      const title = this.element(i, 'pane-title');
      title.textContent = this.viewer.models.length > 1 ? this.viewer.models[pane.index].description.label : '';
      place(title, pane.left + 8, pane.top + 6);
      const scale = this.element(i, 'scale'), { pixels, label } = scaleOf(pane.camera);
      scale.textContent = label;
      scale.style.width = `${pixels}px`;
      place(scale, pane.left + 10, pane.top + pane.height - 28);
      const ring = this.element(i, 'ring'), at = ringOf(pane);
      ring.hidden = !at;
      if (at) place(ring, at[0] - 9, at[1] - 9);
    });
  }
}
