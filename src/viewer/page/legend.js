// The legend, drawn on a canvas of the page or of a saved picture.
import { cssColour, kFlagColours, packedColour, tableIndex } from './colour_maps.js';
import { formatShare, formatValue, ticksWithin } from './format.js';

export const kLegendWidth = 168;
const kBarLeft = 58, kBarWidth = 18, kTop = 76, kBottom = 40, kLine = 16;
const kFont = '13px system-ui, sans-serif';

const textLines = (context, text, width) => {
  const lines = [];
  for (const word of text.split(' ')) {
    const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
    if (lines.length && context.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
};

/** Bar of a legend of this height: pixels of values. */
export function barOf(axis, height) {
  const length = Math.max(height - kTop - kBottom, 40);
  return {
    left: kBarLeft, width: kBarWidth, top: kTop, length,
    yOf: (value) => kTop + length * (1 - (value - axis.low) / (axis.high - axis.low)),
    valueAt: (y) => axis.low + (axis.high - axis.low) * (1 - (y - kTop) / length),
  };
}

export const classTitle = (look, label) =>
  look.name === 'seed' ? ['interpolated', 'seed: rays were cast'][label]
    : look.kind === 'flag' ? `${look.title}: ${label ? 'yes' : 'no'}` : `part ${label}`;

/** legend: {look, axis, histogram, limit, none, colourOfLabel}; ink: colour of text. */
export function drawLegend(context, legend, height, ink) {
  const { look } = legend;
  context.font = `600 ${kFont}`;
  context.fillStyle = ink;
  context.textBaseline = 'middle';
  context.textAlign = 'left';
  const title = textLines(context, look.title, kLegendWidth - 12).slice(0, 2);
  title.forEach((line, i) => context.fillText(line, 8, 14 + i * kLine));
  context.font = kFont;
  if (look.unit) context.fillText(`[${look.unit}]`, 8, 14 + title.length * kLine);
  if (look.kind === 'number' && look.range) drawNumbers(context, legend, height, ink);
  if (look.kind !== 'number') drawClasses(context, legend, height, ink);
  if (look.noValueCount) drawSwatch(context, cssColour(packedColour(legend.none)), 'no value', height - 14, ink);
}

function drawNumbers(context, { look, axis, histogram, limit }, height, ink) {
  const bar = barOf(axis, height);
  const most = Math.max(...histogram.bins) || 1, binHeight = bar.length / histogram.bins.length;
  for (let i = 0; i < histogram.bins.length; ++i) {
    const value = axis.low + (i + 0.5) / histogram.bins.length * (axis.high - axis.low);
    const width = (kBarLeft - 12) * histogram.bins[i] / most;
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    context.fillRect(kBarLeft - 6 - width, bar.yOf(value) - binHeight / 2, width, binHeight + 0.5);
  }
  for (let row = 0; row < bar.length; ++row) {
    const value = bar.valueAt(bar.top + row + 0.5);
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    // Narrower where values are outside of the colours.
    const inset = value < look.low || value > look.high ? 6 : 0;
    context.fillRect(bar.left + inset, bar.top + row, bar.width - 2 * inset, 1);
  }
  context.fillStyle = ink;
  for (const tick of ticksWithin(axis.low, axis.high)) {
    const y = bar.yOf(tick.value);
    context.fillRect(bar.left + bar.width, y - 0.5, 5, 1);
    context.fillText(tick.label, bar.left + bar.width + 20, y);
  }
  if (limit !== null && limit >= axis.low && limit <= axis.high)
    context.fillRect(8, bar.yOf(limit) - 1, bar.left + bar.width - 8, 2);
  const outside = (area, name) => area > 0 ? [`${formatShare(area / histogram.total)} ${name}`] : [];
  if (histogram.total > 0) {
    outside(histogram.above, 'above').forEach((text) => context.fillText(text, 8, kTop - 14));
    outside(histogram.below, 'below').forEach((text) => context.fillText(text, 8, height - kBottom + 12));
  }
}

function drawSwatch(context, colour, text, y, ink) {
  context.fillStyle = colour;
  context.fillRect(8, y - 7, 14, 14);
  context.fillStyle = ink;
  context.fillText(text, 28, y, kLegendWidth - 32);
}

function drawClasses(context, { look, colourOfLabel }, height, ink) {
  const rowCount = Math.max(1, Math.floor((height - kTop - kBottom) / 20));
  const rows = look.classes.slice(0, look.classes.length > rowCount ? rowCount - 1 : rowCount);
  rows.forEach(({ label, share }, i) => {
    const colour = look.kind === 'flag' ? kFlagColours[label] : colourOfLabel(label);
    drawSwatch(context, cssColour(colour), `${classTitle(look, label)} · ${formatShare(share)}`, kTop + 20 * i, ink);
  });
  if (rows.length < look.classes.length)
    context.fillText(`and ${look.classes.length - rows.length} more`, 28, kTop + 20 * rows.length);
}

/** The same in words. */
export function legendSentence(look) {
  const unit = look.unit ? ` ${look.unit}` : '';
  if (look.kind !== 'number') return `${look.title}: ${look.classes.length} classes`;
  if (!look.range) return `${look.title}: no face has a value`;
  return `${look.title}, colours from ${formatValue(look.low)} to ${formatValue(look.high)}${unit}`;
}
