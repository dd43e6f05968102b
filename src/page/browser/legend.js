// Draws the legend, a strip below the view, on a canvas of the page or of a saved picture.
import { colourOfPart, cssColour, kAlarmColour, kBehindColour, kFlagColours, kRestColour, kUncountedColour, packedColour, tableIndex } from './colour_maps.js';
import { formatShare, formatValue, ticksWithin } from './format.js';

export const kLegendHeight = 84;
const kPadding = 16, kMostLength = 760, kBarTop = 44, kBarHeight = 14, kTitle = 14;
const kFont = '13px system-ui, sans-serif';

/** The colour bar of a legend, with the conversions between values and pixels. */
export function barOf(axis, width) {
  const length = Math.max(Math.min(width - 2 * kPadding, kMostLength), 40), span = axis.high - axis.low;
  return {
    left: kPadding, length, top: kBarTop, height: kBarHeight,
    xOf: (value) => kPadding + length * (value - axis.low) / span,
    valueAt: (x) => axis.low + span * (x - kPadding) / length,
  };
}

export const classTitle = (look, label) =>
  look.name === 'seed' ? ['interpolated', 'seed: rays were cast'][label]
    : look.kind === 'flag' ? `${look.title}: ${label ? 'yes' : 'no'}` : `part ${label}`;

/** legend: {look, axis, histogram, thin, none}. ink: colour of the text. */
export function drawLegend(context, legend, width, ink) {
  const { look, thin } = legend;
  context.textBaseline = 'middle';
  context.textAlign = 'left';
  const hasNumbers = !thin && look.kind === 'number';
  const title = thin ? thinTitle(thin) : `${look.title}${look.unit && look.unit !== 'mesh units' ? `, ${look.unit}` : ''}`;
  context.font = `600 ${kFont}`;
  context.fillStyle = ink;
  context.fillText(title, kPadding, kTitle, width - 2 * kPadding);
  const end = kPadding + context.measureText(title).width + 18;
  context.font = kFont;
  if (hasNumbers && look.range) drawNumbers(context, legend, width, ink, end);
  else drawRows(context, thin ? thinRows(thin) : hasNumbers ? [] : classRows(look), width, ink);
  if (!thin && look.noValueCount) drawSwatch(context, cssColour(packedColour(legend.none)), 'no value', width - kPadding - 76, kTitle, ink);
}

const thinTitle = (thin) => `${thin.share > 0 ? '' : 'nowhere '}${thin.title ?? `thinner than ${formatValue(thin.limit)}`}`;

/** Whether thin faces are visible through other faces. */
const showsBehind = ({ share, rest }) => share > 0 && rest === 'glass';

// Thin faces with their share of the area, thin faces behind others, thin faces that do not count, and other faces.
function thinRows(thin) {
  const rows = thin.share > 0 ? [[kRestColour, 'other faces']] : [];
  if (thin.hasUncounted) rows.unshift([kUncountedColour, 'thin, not counted']);
  if (showsBehind(thin)) rows.unshift([kBehindColour, 'behind a wall']);
  if (thin.share > 0) rows.unshift([kAlarmColour, `thin, ${formatShare(thin.share)} of the surface`]);
  return rows;
}

const classRows = (look) => look.classes.map(({ label, share }) =>
  [look.kind === 'flag' ? kFlagColours[label] : colourOfPart(label), `${classTitle(look, label)} · ${formatShare(share)}`]);

function drawNumbers(context, { look, axis, histogram }, width, ink, titleEnd) {
  const bar = barOf(axis, width);
  const most = Math.max(...histogram.bins) || 1, step = bar.length / histogram.bins.length;
  histogram.bins.forEach((area, i) => {
    const value = axis.low + (i + 0.5) / histogram.bins.length * (axis.high - axis.low);
    const height = area > 0 ? Math.max(18 * area / most, 0.5) : 0;
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    context.fillRect(bar.left + i * step, bar.top - 2 - height, step + 0.5, height);
  });
  for (let column = 0; column < bar.length; ++column) {
    const value = bar.valueAt(bar.left + column + 0.5);
    context.fillStyle = cssColour(look.table[tableIndex(value, look.low, look.high)]);
    // The bar is lower outside of the range of the colours.
    const inset = value < look.low || value > look.high ? 5 : 0;
    context.fillRect(bar.left + column, bar.top + inset, 1, bar.height - 2 * inset);
  }
  context.fillStyle = ink;
  context.textAlign = 'center';
  for (const tick of ticksWithin(axis.low, axis.high)) {
    const x = bar.xOf(tick.value), half = context.measureText(tick.label).width / 2;
    context.fillRect(x - 0.5, bar.top + bar.height, 1, 4);
    context.fillText(tick.label, Math.min(Math.max(x, half + 2), width - half - 2), bar.top + bar.height + 14);
  }
  context.textAlign = 'right';
  const outside = ['below', 'above'].filter((side) => histogram[side] > 0);
  const text = outside.map((side) => `${formatShare(histogram[side] / histogram.total)} ${side}`).join(', ');
  const right = bar.left + bar.length;
  if (titleEnd + context.measureText(text).width < right && !look.noValueCount) context.fillText(text, right, kTitle);
  context.textAlign = 'left';
}

function drawSwatch(context, colour, text, x, y, ink) {
  context.fillStyle = colour;
  context.fillRect(x, y - 7, 14, 14);
  context.fillStyle = ink;
  context.fillText(text, x + 20, y);
}

// Swatches in two rows. The last one is a count if not all fit.
function drawRows(context, rows, width, ink) {
  let x = kPadding, y = 40;
  for (let i = 0; i < rows.length; ++i) {
    const [colour, text] = rows[i], needed = 20 + context.measureText(text).width;
    const more = `and ${rows.length - i} more`, isLastRow = y > 40;
    if (x > kPadding && x + needed + (isLastRow && i < rows.length - 1 ? 90 : 0) > width - kPadding) {
      if (isLastRow) {
        context.fillStyle = ink;
        context.fillText(more, x, y);
        return;
      }
      x = kPadding;
      y += 24;
    }
    drawSwatch(context, cssColour(colour), text, x, y, ink);
    x += needed + 18;
  }
}

/** The legend as a sentence, for screen readers. */
export function legendSentence(look, thin) {
  if (thin) return `${thinTitle(thin)}, ${formatShare(thin.share)} of the area${showsBehind(thin) ? '; pale: behind a wall' : ''}`;
  const unit = look.unit ? ` ${look.unit}` : '';
  if (look.kind !== 'number') return `${look.title}: ${look.classes.length} classes`;
  if (!look.range) return `${look.title}: no face has a value`;
  return `${look.title}, colours from ${formatValue(look.low)} to ${formatValue(look.high)}${unit}`;
}
