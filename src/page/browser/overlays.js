// Elements over the view: names of the panes, callouts of places, a ring at the selected face, a scale, and the frame of
// the visible part in the inset.
import { calloutsOf, canvasPixel, dimensionOf, ringRadius } from './callouts.js';
import { formatValue } from './format.js';

/** The scale {value, pixels, label}: the longest round length that fits a quarter of the width of the pane. */
export function scaleOf(camera, unit = '') {
  const most = camera.width / 4 * camera.pixelSize, power = 10 ** Math.floor(Math.log10(most));
  const value = Math.max(...[1, 2, 5].map((step) => step * power).filter((length) => length <= most));
  return { value, pixels: value / camera.pixelSize, label: formatValue(value) + unit };
}

/** Pixel of the canvas at the selected face of a pane, or null. */
export function ringOf(pane) {
  if (!pane.outline) return null;
  const [a, b, c] = pane.outline;
  return canvasPixel(pane, a.map((value, axis) => (value + b[axis] + c[axis]) / 3));
}

function drawn(name, attributes) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

export class Overlays {
  constructor(viewer, folder, visits) {
    Object.assign(this, { viewer, folder, visits });
    viewer.afterFrame.push((panes) => this.update(panes));
  }

  add(id, className, x, y, ...content) {
    const element = Object.assign(document.createElement('div'), { id, className });
    element.append(...content);
    Object.assign(element.style, { left: `${x}px`, top: `${y}px` });
    this.folder.append(element);
    return element;
  }

  update(panes) {
    // Elements are replaced only if something differs, because each change repaints them.
    const { viewer } = this, { state } = viewer;
    const all = panes.filter(({ isInset }) => !isInset).map((pane) => ({
      pane, scale: scaleOf(pane.camera, viewer.unit), ring: ringOf(pane), value: viewer.selectedValue(pane),
      callouts: calloutsOf(pane, viewer), dimension: dimensionOf(pane, viewer),
    }));
    this.showInset(panes.find(({ isInset }) => isInset));
    const key = JSON.stringify([state.place, viewer.generation, all.map(({ pane, ...rest }) => [pane.index, pane.left, pane.top, pane.height, rest])]);
    if (this.shown === key) return;
    this.shown = key;
    const lines = drawn('svg', {});
    this.folder.replaceChildren(lines);
    all.forEach((one, i) => this.show(one, i, lines));
  }

  show({ pane, scale, ring, value, callouts, dimension }, i, lines) {
    const { models, state } = this.viewer;
    if (models.length > 1) this.add(`pane-title-${i}`, 'pane-title', pane.left + 12, pane.top + 8, this.viewer.titleOf(pane.index)).style.maxWidth = `${pane.width - 24}px`;
    this.add(`scale-${i}`, 'scale', pane.left + 16, pane.top + pane.height - 34, scale.label).style.width = `${scale.pixels}px`;
    const radius = ringRadius(pane);
    for (const { index, number, text, x, y, isLeft, column, row } of callouts) {
      const isSelected = state.place === `${pane.index}:${index}`;
      const dx = column - x, dy = row - y, length = Math.hypot(dx, dy) || 1, share = Math.min(radius / length, 1);
      lines.append(drawn('line', { x1: x + dx * share, y1: y + dy * share, x2: column, y2: row }));
      if (!isSelected || !dimension) lines.append(drawn('circle', { cx: x, cy: y, r: radius, class: isSelected ? 'selected' : '' }));
      const badge = Object.assign(document.createElement('b'), { textContent: number });
      const label = this.add(`marker-${i}-${number}`, `callout${isLeft ? ' left' : ''}${isSelected ? ' selected' : ''}${index < 0 ? ' least' : ''}`,
        column, row, badge, ...(text ? [text] : []));
      label.addEventListener('click', () => this.visits.place(pane.index, index));
    }
    if (dimension) {
      const [[x1, y1], [x2, y2]] = dimension;
      for (const name of ['dimension ground', 'dimension']) lines.append(drawn('line', { x1, y1, x2, y2, class: name }));
      for (const [cx, cy] of dimension) lines.append(drawn('circle', { cx, cy, r: 4, class: 'end' }));
    }
    if (!ring) return;
    const [x, y] = ring;
    lines.append(drawn('circle', { cx: x, cy: y, r: radius, class: 'face', id: `ring-${i}` }));
    const isRight = x > pane.left + pane.width - 160;
    if (value) this.add(`value-${i}`, isRight ? 'value right' : 'value', isRight ? x - 16 : x + 16, y, value);
  }

  // The inset is a button; its frame shows which part of the mesh is visible in the pane.
  showInset(inset) {
    const button = document.getElementById('inset'), { style } = button, frame = button.firstElementChild;
    button.hidden = !inset;
    if (!inset) return;
    const { seen: { camera } } = inset, scale = camera.pixelSize / inset.camera.pixelSize;
    const [x, y] = inset.camera.pixelOf(camera.target), [width, height] = [camera.width * scale, camera.height * scale];
    Object.assign(style, { left: `${inset.left}px`, top: `${inset.top}px`, width: `${inset.width}px`, height: `${inset.height}px` });
    Object.assign(frame.style, { left: `${x - width / 2}px`, top: `${y - height / 2}px`, width: `${width}px`, height: `${height}px` });
  }
}
