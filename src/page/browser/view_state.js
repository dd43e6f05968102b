// The state of the view as named values. The fragment of the address of the page holds the same values.
import { kColourMapNames } from './colour_maps.js';

const number = (fallback) => ({ fallback, read: (text) => Number.isFinite(parseFloat(text)) ? parseFloat(text) : fallback });
const flag = { fallback: false, read: (text) => text === '1' };
const choice = (...names) => ({ fallback: names[0], read: (text) => names.includes(text) ? text : names[0] });
const text = (fallback, pattern) => ({ fallback, read: (value) => pattern.test(value) ? value : fallback });

const kParts = {
  layer: text(null, /./),
  show: text('all', /^(\d+|\d+-\d+|all)$/),  // All meshes, one mesh, or the difference of two.
  map: choice(...kColourMapNames),
  low: number(null), high: number(null),     // Ends of the colours; null: percentiles.
  none: text('d48fb8', /^[0-9a-f]{6}$/),     // Colour of faces without a value.
  thin: flag, thinAt: number(null),          // Limit; null: the given limit, or the lower end of the colours.
  rest: choice('glass', 'grey', 'hidden'),   // Faces that are not thin or not of the selected part.
  shading: choice('flat', 'smooth', 'plain'), edges: flag, back: choice('same', 'grey', 'hidden'),
  clip: choice('off', 'x', 'y', 'z', 'view'), clipAt: number(0.5), clipFlip: flag,
  face: text(null, /^\d+:\d+$/), part: text(null, /^\d+:\d+$/),  // Numbers MESH:FACE and MESH:PART.
  place: text(null, /^\d+:-?\d+$/),         // MESH:INDEX, as in placesOf().
  up: choice('auto', 'y', 'z', 'x', '-y', '-z', '-x'),  // auto: the upright axis of each mesh.
  az: number(30), el: number(18), zoom: number(null), x: number(0), y: number(0), z: number(0),
};

export const kInitialState = Object.fromEntries(Object.entries(kParts).map(([key, part]) => [key, part.fallback]));

const asText = (value) => value === true ? '1' : typeof value === 'number' ? String(Number(value.toPrecision(6))) : value;

/** The fragment of a state. Values that equal those of `initial` are left out. */
export function fragmentOf(state, initial) {
  const changed = Object.keys(kParts).filter((key) => state[key] !== initial[key] && state[key] !== null);
  return changed.map((key) => `${key}=${encodeURIComponent(state[key] === false ? '0' : asText(state[key])).replace('%3A', ':')}`).join('&');
}

/** The values in a fragment. Unknown keys are ignored. */
export function stateOfFragment(fragment) {
  const state = {};
  for (const [key, value] of new URLSearchParams(fragment.replace(/^#/, '')))
    if (Object.hasOwn(kParts, key)) state[key] = kParts[key].read(value);
  return state;
}

/** The state. Its listeners are called with the set of changed keys. */
export class Store {
  constructor(state) {
    this.state = state;
    this.listeners = [];
  }

  set(changes) {
    const keys = Object.keys(changes).filter((key) => changes[key] !== this.state[key]);
    if (!keys.length) return;
    Object.assign(this.state, changes);
    for (const listener of this.listeners) listener(new Set(keys));
  }
}
