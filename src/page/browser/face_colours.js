// Packed colours of the faces of a mesh. Alpha 0 marks the rest: faces that are not highlighted.
import { colourOfPart, kAlarmColour, kFlagColours, packedColour, tableIndex } from './colour_maps.js';

// layer: {kind}; for numbers {kind, low, high, table}. style: {none, below, part}. `below` {values, limit}: faces
// below the limit have the alarm colour, others are the rest. `part` {labels, label}: other parts are the rest.
export function colourFaces(values, layer, style) {
  const none = packedColour(style.none), colours = new Uint32Array(values.length);
  if (style.below) {
    const { values: limited, limit } = style.below;
    for (let i = 0; i < colours.length; ++i) colours[i] = limited[i] < limit ? kAlarmColour : 0;
  } else if (layer.kind === 'number') {
    const { low, high, table } = layer;
    const scale = high > low ? 255 / (high - low) : 0, offset = scale > 0 ? 0.5 : tableIndex(0, 0, 0);
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      colours[i] = value === value ? table[Math.min(Math.max((value - low) * scale + offset, 0), 255) | 0] : none;
    }
  } else {
    for (let i = 0; i < values.length; ++i)
      colours[i] = (layer.kind === 'flag' ? kFlagColours[values[i]] : colourOfPart(values[i])) ?? none;
  }
  if (style.part) {
    const { labels, label } = style.part;
    for (let i = 0; i < colours.length; ++i) if (labels[i] !== label) colours[i] = 0;
  }
  return colours;
}
