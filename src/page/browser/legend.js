// Draws the legend on a canvas of the page or of a saved picture.
import { colourOfPart, cssColour, kAlarmColour, kBehindColour, kFlagColours, kRestColour, packedColour, tableIndex } from './colour_maps.js';
import { formatShare, formatValue, ticksWithin } from './format.js';

const kBarWidth = 18, kTop = 76, kBottom = 40, kLine = 16;
/** Sizes of the legend. The narrow one has no histogram. */
export const kWideLegend = { width: 168, barLeft: 58 }, kNarrowLegend = { width: 92, barLeft: 8 };
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

/** The colour bar of a legend, with the conversions between values and pixels. */
export function barOf(axis, height, { barLeft }) {
  const length = Math.max(height - kTop - kBottom, 40);
  return {
    left: barLeft, width: kBarWidth, top: kTop, length,
    yOf: (value) => kTop + length * (1 - (value - axis.low) / (axis.high - axis.low)),
    valueAt: (y) => axis.low + (axis.high - axis.low) * (1 - (y - kTop) / length),
  };
}

export const classTitle = (look, label) =>
  look.name === 'seed' ? ['interpolated', 'seed: rays were cast'][label]
    : look.kind === 'flag' ? `${look.title}: ${label ? 'yes' : 'no'}` : `part ${label}`;

/** legend: {look, axis, histogram, thin, none}. size: kWideLegend or kNarrowLegend. ink: colour of the text. */
export function drawLegend(context, legend, height, size, ink) {
  const { look, thin } = legend;
  context.font = `600 ${kFont}`;
  context.fillStyle = ink;
  context.textBaseline = 'middle';
  context.textAlign = 'left';
  const title = textLines(context, thin ? thinTitle(thin) : look.title, size.width - 12).slice(0, 3);
  title.forEach((line, i) => context.fillText(line, 8, 14 + i * kLine));
  context.font = kFont;
  if (thin) return drawThin(context, thin, 14 + title.length * kLine, size, ink);
  if (look.unit) context.fillText(`[${look.unit}]`, 8, 14 + title.length * kLine, size.width - 8);
  if (look.kind === 'number' && look.range) drawNumbers(context, legend, height, size, ink);
  if (look.kind !== 'number') drawClasses(context, legend, height, size, ink);
  if (look.noValueCount) drawSwatch(context, cssColour(packedColour(legend.none)), 'no value', height - 14, size, ink);
}

const thinTitle = (thin) => `${thin.share > 0 ? '' : 'nowhere '}${thin.title ?? `thinner than ${formatValue(thin.limit)}`}`;

/** Whether thin faces are visible through other faces. */
const showsBehind = ({ share, rest }) => share > 0 && rest === 'glass';

// Rows of the legend: thin faces with their share of the area, thin faces behind others, and other faces.
function drawThin(context, thin, top, size, ink) {
  const rows = [[kRestColour, 'other']];
  if (showsBehind(thin)) rows.unshift([kBehindColour, 'thin, behind a wall']);
  if (thin.share > 0) rows.unshift([kAlarmColour, `thin, ${formatShare(thin.share)}`]);
  rows.forEach(([colour, text], i) => drawSwatch(context, cssColour(colour), text, top + 10 + 22 * i, size, ink));
}

function drawNumbers(context, { look, axis, histogram }, height, size, ink) {
  const bar = barOf(axis, height, size), { barLeft } = size;
  const most = Math.max(...histogram.bins) || 1, binHeight = bar.length / histogram.bins.length;
  for (let i = 0; i < histogram.bins.length && barLeft > 12; ++i) {
    const value = axis.low + (i + 0.5) / histogram.bins.length * (axis.high - axis.low);
    const width = (barLeft - 12) * histogram.bins[i] / most;
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    context.fillRect(barLeft - 6 - width, bar.yOf(value) - binHeight / 2, width, binHeight + 0.5);
  }
  for (let row = 0; row < bar.length; ++row) {
    const value = bar.valueAt(bar.top + row + 0.5);
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    // The bar is narrower outside of the range of the colours.
    const inset = value < look.low || value > look.high ? 6 : 0;
    context.fillRect(bar.left + inset, bar.top + row, bar.width - 2 * inset, 1);
  }
  context.fillStyle = ink;
  for (const tick of ticksWithin(axis.low, axis.high)) {
    const y = bar.yOf(tick.value);
    context.fillRect(bar.left + bar.width, y - 0.5, 5, 1);
    context.fillText(tick.label, bar.left + bar.width + 20, y);
  }
  const outside = (area, name) => area > 0 ? [`${formatShare(area / histogram.total)} ${name}`] : [];
  if (histogram.total > 0) {
    outside(histogram.above, 'above').forEach((text) => context.fillText(text, 8, kTop - 14, size.width - 8));
    outside(histogram.below, 'below').forEach((text) => context.fillText(text, 8, height - kBottom + 12, size.width - 8));
  }
}

function drawSwatch(context, colour, text, y, size, ink) {
  context.fillStyle = colour;
  context.fillRect(8, y - 7, 14, 14);
  context.fillStyle = ink;
  context.fillText(text, 28, y, size.width - 32);
}

function drawClasses(context, { look }, height, size, ink) {
  const rowCount = Math.max(1, Math.floor((height - kTop - kBottom) / 20));
  const rows = look.classes.slice(0, look.classes.length > rowCount ? rowCount - 1 : rowCount);
  rows.forEach(({ label, share }, i) => {
    const colour = look.kind === 'flag' ? kFlagColours[label] : colourOfPart(label);
    drawSwatch(context, cssColour(colour), `${classTitle(look, label)} · ${formatShare(share)}`, kTop + 20 * i, size, ink);
  });
  if (rows.length < look.classes.length)
    context.fillText(`and ${look.classes.length - rows.length} more`, 28, kTop + 20 * rows.length);
}

/** The legend as a sentence, for screen readers. */
export function legendSentence(look, thin) {
  if (thin) return `${thinTitle(thin)}, ${formatShare(thin.share)} of the area${showsBehind(thin) ? '; pale: behind a wall' : ''}`;
  const unit = look.unit ? ` ${look.unit}` : '';
  if (look.kind !== 'number') return `${look.title}: ${look.classes.length} classes`;
  if (!look.range) return `${look.title}: no face has a value`;
  return `${look.title}, colours from ${formatValue(look.low)} to ${formatValue(look.high)}${unit}`;
}
