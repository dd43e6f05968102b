// The fields of all meshes as layers. look() computes values per mesh, range, colours and histogram for a state.
import { colourTable } from './colour_maps.js';
import { facesBelow, histogramOf, rangeOf } from './statistics.js';

const kHistogramBinCount = 60;
const kMargin = 0.2;  // Margin of the legend beyond each end of the colours, as a share of the range of the colours.

export class Layers {
  constructor(models) {
    this.models = models;
    this.cache = new Map();
    const fields = models.flatMap((model) => model.description.fields);
    this.fields = fields.filter((field, i) => fields.findIndex((other) => other.name === field.name) === i);
  }

  cached(key, compute) {
    if (!this.cache.has(key)) this.cache.set(key, compute());
    return this.cache.get(key);
  }

  fieldNamed(name) {
    return this.fields.find((field) => field.name === name) ?? this.fields[0];
  }

  has(name) {
    return this.fields.some((field) => field.name === name);
  }

  /** Range {low, high, min, max} of a field over all meshes; null without values. */
  rangeOf(name) {
    return this.cached(`range ${name} false`, () => rangeOf(this.models.map((_, index) => this.part(index, this.valuesOf(index, name)))));
  }

  part(index, values) {
    return { values, areas: this.models[index].areas };
  }

  /** Indices of the meshes that a state shows. */
  shown({ show }) {
    return show === 'all' ? this.models.map((_, index) => index) : [Number(show.split('-')[0])];
  }

  /** Whether both meshes have the same face count and nearly the same box. */
  areComparable(one, other) {
    const [a, b] = [this.models[one], this.models[other]];
    const size = Math.hypot(...a.boxMax.map((value, axis) => value - a.boxMin[axis]));
    return a.faceCount === b.faceCount && ['boxMin', 'boxMax'].every((end) => a.description[end].every(
      (value, axis) => Math.abs(value - b.description[end][axis]) <= 1e-4 * size));
  }

  /** The face of mesh `other` that has the same number in its file; -1 if there is none. */
  sameFace(one, face, other) {
    return one === other ? face : this.models[other].faceOfId(this.models[one].faceIds[face]);
  }

  /** Values of mesh `one` minus those of mesh `other`, for the faces of `one`. */
  difference(one, other, name) {
    return this.cached(`${one}-${other} ${name}`, () => {
      const [a, b] = [this.models[one], this.models[other]], values = a.fields.get(name), others = b.fields.get(name);
      if (!values || !others) return new Float32Array(a.faceCount).fill(NaN);
      const byId = new Float32Array(a.faceIds.reduce((most, id) => Math.max(most, id), 0) + 1).fill(NaN);
      b.faceIds.forEach((id, face) => byId[id] = others[face]);
      return values.map((value, face) => value - byId[a.faceIds[face]]);
    });
  }

  valuesOf(index, name) {
    return this.models[index].fields.get(name)
      ?? this.cached(`none ${index}`, () => new Float32Array(this.models[index].faceCount).fill(NaN));
  }

  /** How the state shows a layer: a pane {index, values} per visible mesh, and the data of legend and colours. */
  look(state) {
    const field = this.fieldNamed(state.layer), { name, kind } = field;
    const pair = state.show.includes('-') && kind === 'number' ? state.show.split('-').map(Number) : null;
    const panes = this.shown(state).map((index) => ({ index, values: pair ? this.difference(...pair, name) : this.valuesOf(index, name) }));
    const look = {
      name, kind, panes, isDifference: Boolean(pair), unit: field.unit, parts: panes.map(({ index, values }) => this.part(index, values)),
      title: pair ? `difference of ${field.title}` : field.title,
      noValueCount: panes.reduce((sum, { values }) => sum + values.reduce((count, v) => count + (v !== v), 0), 0),
    };
    if (kind === 'number') Object.assign(look, this.numbers(state, look));
    else look.classes = this.classes(look);
    return look;
  }

  // All meshes have the same range, so that their colours can be compared.
  numbers(state, look) {
    const range = look.isDifference ? this.cached(`range ${look.name} ${state.show}`, () => rangeOf(look.parts)) : this.rangeOf(look.name);
    const table = this.cached(`table ${look.isDifference || state.map}`,
      () => colourTable(look.isDifference ? 'difference' : state.map));
    if (!range) return { table, low: 0, high: 1, range: null };
    const most = Math.max(Math.abs(range.low), Math.abs(range.high));
    const automatic = look.isDifference ? { low: -most, high: most } : range;
    let low = state.low ?? automatic.low, high = state.high ?? automatic.high;
    if (low > high) [low, high] = [high, low];
    return { table, low, high, range, automatic };
  }

  // Labels or flags with their shares of the area, in descending order.
  classes(look) {
    const areas = new Map();
    let total = 0;
    for (const { index, values } of look.panes) {
      total += this.models[index].totalArea;
      for (const [label, area] of this.models[index].labelAreas(values))
        areas.set(label, (areas.get(label) ?? 0) + area);
    }
    const shares = [...areas].sort((a, b) => b[1] - a[1]);
    return shares.map(([label, area]) => ({ label, share: total > 0 ? area / total : 0 }));
  }

  /** The interval of the legend: the range of the colours, with margins that end at the least and the greatest value.
  */
  axisOf({ low, high, range }) {
    if (!range) return { low: 0, high: 1 };
    const margin = high > low ? kMargin * (high - low) : Math.abs(low) * 0.1 || 0.5;
    if (!(high > low)) return { low: low - margin, high: high + margin };
    return { low: Math.min(low, Math.max(range.min, low - margin)), high: Math.max(high, Math.min(range.max, high + margin)) };
  }

  histogram(look, axis) {
    return histogramOf(look.parts, axis.low, axis.high, kHistogramBinCount);
  }

  /** Count and area of the faces of the panes whose value of the field `name` is below a limit. */
  below(look, name, limit) {
    return facesBelow(name === look.name ? look.parts : look.panes.map(({ index }) => this.part(index, this.valuesOf(index, name))), limit);
  }
}
