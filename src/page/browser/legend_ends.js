// The legend of the page. Mouse, touch and keys move the handles at the two ends of its colours.
import { formatValue } from './format.js';
import { barOf, drawLegend, legendSentence } from './legend.js';
import { hasUncounted, thinShare } from './thin_places.js';
import { clamp } from './vectors.js';

export class LegendPanel {
  constructor(viewer, folder) {
    this.viewer = viewer;
    this.folder = folder;
    this.canvas = folder.querySelector('canvas');
    this.ends = ['low', 'high'].map((end) => this.prepare(end, document.getElementById(`legend-${end}`)));
    viewer.afterFrame.push(() => this.update());
    new ResizeObserver(() => {
      this.drawn = null;
      this.update();
    }).observe(folder);
  }

  prepare(end, element) {
    element.addEventListener('pointerdown', (event) => {
      element.setPointerCapture(event.pointerId);
      this.dragged = end;
    });
    element.addEventListener('pointermove', (event) => {
      if (this.dragged === end) this.set(end, this.bar.valueAt(event.clientX - this.folder.getBoundingClientRect().left));
    });
    for (const name of ['pointerup', 'pointercancel']) {
      element.addEventListener(name, () => {
        this.dragged = null;
        this.drawn = null;
        this.update();
      });
    }
    element.addEventListener('dblclick', () => this.viewer.store.set({ [end]: null }));
    element.addEventListener('keydown', (event) => {
      const { low, high, range } = this.viewer.look, step = (high - low || Math.abs(low) || 1) / 100;
      const value = end === 'low' ? low : high;
      const values = {
        ArrowUp: value + step, ArrowRight: value + step, ArrowDown: value - step, ArrowLeft: value - step,
        PageUp: value + 10 * step, PageDown: value - 10 * step, Home: range.min, End: range.max,
      };
      if (!(event.key in values)) return;
      event.preventDefault();
      this.set(end, values[event.key]);
    });
    return { end, element };
  }

  // The ends cannot pass each other. A dragged end stays within the legend.
  set(end, value) {
    const { low, high, range, isDifference } = this.viewer.look;
    const axis = this.dragged ? this.axis : isDifference ? { low: -Infinity, high: Infinity } : { low: range.min, high: range.max };
    const held = clamp(value, axis.low, axis.high);
    this.viewer.store.set(end === 'low' ? { low: Math.min(held, high), high } : { low, high: Math.max(held, low) });
  }

  /** The argument `legend` of drawLegend(). */
  legend() {
    const { viewer, axis } = this, { look, state, thin } = viewer;
    return {
      look, axis, thin: thin && { ...thin, share: thinShare(viewer), hasUncounted: thin.isGiven && hasUncounted(viewer), rest: state.rest }, histogram: this.histogram, none: state.none,
    };
  }

  update() {
    const { viewer } = this;
    if (!viewer.models.length) return;
    const { look } = viewer;
    const key = JSON.stringify([viewer.generation, look.name, viewer.state.show, viewer.state.map, look.low, look.high, viewer.thin,
      viewer.state.rest, viewer.state.none, viewer.theme().ink]);
    if (this.drawn === key) return;
    this.drawn = key;
    if (look.kind === 'number' && !this.dragged) {
      this.axis = viewer.layers.axisOf(look);
      this.histogram = viewer.layers.histogram(look, this.axis);
    }
    this.draw();
  }

  draw() {
    const { viewer, canvas, axis } = this, { look, thin } = viewer, { clientWidth: width, clientHeight: height } = this.folder;
    const legend = this.legend();
    const ratio = Math.min(devicePixelRatio, 2);
    Object.assign(canvas, { width: Math.max(width * ratio, 1), height: height * ratio });
    const context = canvas.getContext('2d');
    context.scale(ratio, ratio);
    const hasEnds = !thin && look.kind === 'number' && Boolean(look.range);
    for (const { element } of this.ends) element.hidden = !hasEnds;
    if (look.kind === 'none') return;
    drawLegend(context, legend, width, viewer.theme().ink);
    canvas.setAttribute('aria-label', legendSentence(look, legend.thin));
    if (!hasEnds) return;
    this.bar = barOf(axis, width);
    for (const { end, element } of this.ends) {
      const value = look[end];
      element.style.left = `${this.bar.xOf(value)}px`;
      element.setAttribute('aria-valuenow', value);
      element.setAttribute('aria-valuemin', look.range.min);
      element.setAttribute('aria-valuemax', look.range.max);
      element.setAttribute('aria-valuetext', `${formatValue(value)} ${look.unit}`);
    }
  }
}
