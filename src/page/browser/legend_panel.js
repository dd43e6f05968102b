// The legend beside the view.
import { drawLegend, kNarrowLegend, kWideLegend, legendSentence } from './legend.js';
import { thinShare } from './thin_places.js';

export class LegendPanel {
  constructor(viewer, folder) {
    this.viewer = viewer;
    this.folder = folder;
    this.canvas = folder.querySelector('canvas');
    viewer.afterFrame.push(() => this.update());
    new ResizeObserver(() => {
      this.drawn = null;
      this.update();
    }).observe(folder);
  }

  /** What drawLegend() draws. */
  legend() {
    const { viewer, axis } = this, { look, state, thin } = viewer;
    return {
      look, axis, thin: thin && { ...thin, share: thinShare(viewer) }, histogram: this.histogram, none: state.none,
      colourOfLabel: (label) => look.panes
        .map(({ index }) => viewer.layers.labelColours(index, look.name).get(label)).find((colour) => colour !== undefined),
    };
  }

  update() {
    const { viewer } = this, { look } = viewer;
    const key = JSON.stringify([look.name, viewer.state.show, viewer.state.map, look.low, look.high, viewer.thin,
      viewer.state.none, viewer.theme().ink]);
    if (this.drawn === key) return;
    this.drawn = key;
    if (look.kind === 'number') {
      this.axis = viewer.layers.axisOf(look);
      this.histogram = viewer.layers.histogram(look, this.axis);
    }
    this.draw();
  }

  draw() {
    const { viewer, canvas } = this, { look } = viewer, height = this.folder.clientHeight;
    const size = this.folder.clientWidth < kWideLegend.width ? kNarrowLegend : kWideLegend, legend = this.legend();
    const ratio = Math.min(devicePixelRatio, 2);
    Object.assign(canvas, { width: size.width * ratio, height: Math.max(height * ratio, 1) });
    const context = canvas.getContext('2d');
    context.scale(ratio, ratio);
    if (look.kind === 'none') return;
    drawLegend(context, legend, height, size, viewer.theme().ink);
    canvas.setAttribute('aria-label', legendSentence(look, legend.thin));
  }
}
