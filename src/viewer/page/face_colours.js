// Packed colours of the faces of a mesh; alpha 0 hides a face.
import { kFlagColours, packedColour, tableIndex } from './colour_maps.js';

const kRest = packedColour('b9bcc2');

/**
 * layer: {kind, low, high, table} or {kind, colours} by label; style: {none, limit, part, hidesRest}. Faces that are not
 * below `limit`, or not of the part (labels of `part.labels`), are grey or hidden.
 */
export function colourFaces(values, layer, style) {
  const none = packedColour(style.none), rest = style.hidesRest ? 0 : kRest;
  const colours = new Uint32Array(values.length);
  const limit = style.limit ?? Infinity;
  if (layer.kind === 'number') {
    const { low, high, table } = layer;
    const scale = high > low ? 255 / (high - low) : 0, offset = scale > 0 ? 0.5 : tableIndex(0, 0, 0);
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      if (value >= limit) colours[i] = rest;
      else if (value === value) colours[i] = table[Math.min(Math.max((value - low) * scale + offset, 0), 255) | 0];
      else colours[i] = style.limit === null ? none : rest;
    }
  } else {
    for (let i = 0; i < values.length; ++i)
      colours[i] = (layer.kind === 'flag' ? kFlagColours[values[i]] : layer.colours.get(values[i])) ?? none;
  }
  if (style.part) {
    const { labels, label } = style.part;
    for (let i = 0; i < colours.length; ++i) if (labels[i] !== label) colours[i] = rest;
  }
  return colours;
}
