// The form. Each element with data-key shows and sets a part of the state.
import { byId, made } from './elements.js';
import { formatCount, formatShare, formatValue } from './format.js';
import { classTitle } from './legend.js';
import { givenLimit } from './thin_places.js';
import { kViews } from './camera.js';

export class Controls {
  constructor(viewer, navigation, visits, picture) {
    this.viewer = viewer;
    for (const element of document.querySelectorAll('[data-key]'))
      element.addEventListener(element.type === 'number' ? 'change' : 'input', () => this.read(element));
    const click = (id, action) => byId(id).addEventListener('click', action);
    for (const name of Object.keys(kViews)) click(`view-${name}`, () => navigation.view(name));
    click('reset', () => navigation.resetView());
    click('reset-all', () => viewer.reset());
    click('png', () => picture.save());
    click('range-auto', () => viewer.store.set({ low: null, high: null }));
    click('range-full', () => this.setFullRange());
    click('part-none', () => viewer.store.set({ part: null }));
    click('thin-given', () => viewer.store.set({ thin: true, thinAt: null }));
    byId('go-to-face').addEventListener('submit', (event) => {
      event.preventDefault();
      const id = Number(byId('face-number').value), index = viewer.look.panes[0]?.index ?? 0;
      if (!visits.face(index, id, 0)) byId('picked').textContent = `There is no face ${id}.`;
    });
    viewer.store.listeners.push((keys) => this.show(keys));
    viewer.afterLoad.push(() => this.fill());
  }

  /** Fills the choices for new models. */
  fill() {
    this.given = givenLimit(this.viewer.models);
    this.shownFace = undefined;
    const { layers, models } = this.viewer;
    byId('layer').replaceChildren(...layers.fields.map(({ name, title }) => new Option(title, name)));
    const labels = models.map(({ description }) => description.label || description.name);
    const pairs = models.flatMap((_, a) => models.map((_, b) => [a, b]))
      .filter(([a, b]) => a > b && layers.areComparable(a, b));
    byId('show').replaceChildren(new Option('all side by side', 'all'), ...labels.map((label, i) => new Option(label, i)),
      ...pairs.map(([a, b]) => new Option(`${labels[a]} minus ${labels[b]}`, `${a}-${b}`)));
    byId('show-row').hidden = models.length < 2;
    this.show(null);
  }

  read(element) {
    const key = element.dataset.key, { viewer } = this;
    const value = element.type === 'checkbox' ? element.checked : element.type === 'color' ? element.value.slice(1)
      : ['number', 'range'].includes(element.type) ? (element.value === '' ? null : Number(element.value)) : element.value;
    const changes = { [key]: value };
    if (key === 'layer' || key === 'show') Object.assign(changes, { low: null, high: null });
    if (key === 'layer') changes.thinAt = null;
    // The selection of a layer or of a difference ends the view of the thin places of the results.
    if (this.given !== null && (key === 'layer' || String(changes.show).includes('-'))) changes.thin = false;
    if (key === 'thinAt' && value !== null) changes.thin = true;
    if (key === 'up' || key === 'show') Object.assign(changes, viewer.fitted({ ...viewer.state, ...changes }));
    viewer.store.set(changes);
    this.show(null);
  }

  setFullRange() {
    const { range } = this.viewer.look;
    if (range) this.viewer.store.set({ low: range.min, high: range.max });
  }

  /** Shows the state in the form. keys: the changed keys of the state; null: all. */
  show(keys) {
    const { viewer } = this, { state } = viewer;
    if (!viewer.models.length) return;
    if (keys && ![...keys].some((key) => !['az', 'el', 'x', 'y', 'z', 'zoom'].includes(key))) return;
    const { look } = viewer, isNumber = look.kind === 'number' && Boolean(look.range);
    const shown = { ...state, none: `#${state.none}` };
    if (isNumber) Object.assign(shown, { low: rounded(look.low), high: rounded(look.high) });
    const limited = this.limitedRange(look);
    if (limited) {
      shown.thinAt = rounded(state.thinAt ?? this.given ?? look.low);
      const slider = byId('thin-slider');
      slider.min = limited.min;
      slider.max = limited.max;
      slider.step = (limited.max - limited.min) / 500 || 1;
    }
    for (const element of document.querySelectorAll('[data-key]')) {
      const value = shown[element.dataset.key];
      if (element.type === 'checkbox') element.checked = value;
      else if (element.value !== String(value)) element.value = value ?? '';
    }
    byId('colours').disabled = !isNumber || Boolean(viewer.thin);
    byId('threshold').disabled = !limited && this.given === null;
    byId('thin-given').hidden = this.given === null || Boolean(viewer.thin?.isGiven);
    byId('clip-at').disabled = state.clip === 'off';
    byId('part-none').hidden = !state.part;
    this.showThin(look);
    this.showPicked();
  }

  /** Range of the values that the limit is compared with; null without values. */
  limitedRange(look) {
    const { layers } = this.viewer;
    if (this.given !== null && layers.has('least_thickness')) return layers.rangeOf('least_thickness');
    return look.kind === 'number' ? look.range : null;
  }

  showThin(look) {
    const { thin, layers, models } = this.viewer;
    let text = '';
    if (thin && !thin.isGiven) {
      const { limit, name } = thin, { count, area, total } = layers.below(look, name, limit);
      const hasPolygons = models.some(({ description }) => description.inputFaceCount < description.faceCount);
      text = `${formatCount(count)} ${hasPolygons ? 'triangles' : 'faces'} below ${formatValue(limit)}, area `
        + `${formatValue(area)} (${formatShare(total > 0 ? area / total : 0)} of the surface)`;
    }
    if (byId('thin-result').textContent !== text) byId('thin-result').textContent = text;
  }

  showPicked() {
    const { viewer } = this, selected = viewer.selected(), output = byId('picked');
    if (this.shownFace === viewer.state.face) return;
    this.shownFace = viewer.state.face;
    if (!selected) {
      output.textContent = 'Click a face, or enter its number.';
      return;
    }
    byId('face-number').value = selected.id;
    const list = made('dl', {}, made('dt', {}, 'face'), made('dd', { id: 'picked-id' }, formatCount(selected.id)));
    viewer.models.forEach((model, index) => {
      const face = viewer.faceIn(index, selected);
      if (face < 0) return;
      if (viewer.models.length > 1) list.append(made('dt', { className: 'mesh' }, 'result'), made('dd', {}, model.description.label));
      for (const field of model.description.fields) {
        const value = model.fields.get(field.name)[face];
        const text = Number.isNaN(value) ? 'no value' : field.kind !== 'number' ? classTitle(field, value)
          : `${formatValue(value)} ${field.unit}`;
        list.append(made('dt', {}, field.title), made('dd', { id: `picked-${index}-${field.name}` }, text));
      }
      list.append(made('dt', {}, 'area'), made('dd', {}, formatValue(model.areas[face])));
    });
    output.replaceChildren(list);
  }
}

const rounded = (value) => Number(value.toPrecision(4));
