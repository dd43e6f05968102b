// The tabs: walls, diameter and parts, as far as the results have them, and the button for everything else.
import { byId } from './elements.js';
import { markRow } from './lists.js';
import { givenLimit } from './thin_places.js';

const kWallFields = ['least_thickness', 'thickness', 'least_gap', 'gap'];

/** The changes of the state with which a tab begins; null if the results have no such tab. */
function tabState(name, { layers, models }) {
  const common = { part: null, face: null, low: null, high: null, thin: false, thinAt: null };
  if (name === 'walls') {
    const hasLimit = givenLimit(models) !== null, layer = kWallFields.find((one) => layers.has(one));
    return hasLimit || layer ? { ...common, layer: layer ?? layers.fields[0]?.name ?? null, thin: hasLimit } : null;
  }
  const layer = name === 'parts' ? 'segment' : layers.has('sdf') ? 'sdf' : layers.fields.find((field) => field.kind === 'number' && !kWallFields.includes(field.name))?.name;
  return layer && layers.has(layer) ? { ...common, layer, place: null } : null;
}

function tabOf({ thin, layer }, { models }) {
  if ((thin && givenLimit(models) !== null) || kWallFields.includes(layer)) return 'walls';
  return layer === 'segment' ? 'parts' : 'diameter';
}

export class Tabs {
  /** makeMissing(name): computes what a tab shows, and selects the tab; null if the results are complete. */
  constructor(viewer) {
    Object.assign(this, { viewer, makeMissing: null });
    this.names = ['walls', 'diameter', 'parts'];
    for (const name of this.names) {
      byId(`tab-${name}`).addEventListener('click', () => this.select(name));
      byId(`tab-${name}`).addEventListener('keydown', (event) => this.key(event, name));
    }
    byId('tab-more').addEventListener('click', () => this.open(byId('more').hidden));
    viewer.store.listeners.push(() => this.show());
    viewer.afterLoad.push(() => this.fill());
  }

  fill() {
    for (const name of this.names) byId(`tab-${name}`).hidden = !this.makeMissing && !tabState(name, this.viewer);
    this.show();
  }

  select(name) {
    this.open(false);
    const state = tabState(name, this.viewer);
    if (state) this.viewer.store.set(state);
    else this.makeMissing(name);
    this.show();
  }

  key(event, name) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const shown = this.names.filter((one) => !byId(`tab-${one}`).hidden);
    const next = byId(`tab-${shown[(shown.indexOf(name) + step + shown.length) % shown.length]}`);
    event.preventDefault();
    next.focus();
    next.click();
  }

  /** Shows or hides everything else. */
  open(isOpen) {
    byId('more').hidden = !isOpen;
    byId('tab-more').setAttribute('aria-expanded', String(isOpen));
    this.show();
  }

  show() {
    const { viewer } = this, { state, models } = viewer;
    if (!models.length) return;
    const selected = tabOf(state, viewer), isMore = !byId('more').hidden;
    for (const name of this.names) {
      const isShown = name === selected && !isMore;
      byId(`tab-${name}`).setAttribute('aria-selected', String(isShown));
      byId(`panel-${name}`).hidden = !isShown;
    }
    markRow(state, models.map(({ description }) => description));
  }
}
