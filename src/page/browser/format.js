
const kMaxTickCount = 6;

// Returns "1e7" for "1e+7".
const shortExponent = (text) => text.replace('e+', 'e');

function withDigits(value, digits) {
  if (value === null || Number.isNaN(value)) return 'no value';
  const size = Math.abs(value);
  if (size >= 1e6 || (size > 0 && size < 1e-3)) return shortExponent(value.toExponential(digits - 1));
  if (size >= 1e4) return formatCount(Math.round(value));
  return String(Number(value.toPrecision(digits)));
}

// A number with four significant digits, without trailing zeros after a decimal point. A value that differs from
// `limit` gets up to nine digits, if fewer digits would give the text of `limit`.
export function formatValue(value, limit = value) {
  for (let digits = 4; digits <= 9; ++digits)
    if (withDigits(value, digits) !== withDigits(limit, digits)) return withDigits(value, digits);
  return withDigits(value, 4);
}

export const formatCount = (count) => count.toLocaleString('en-US');

export const formatShare = (share) => `${Number((100 * share).toPrecision(share < 0.1 ? 2 : 3))} %`;

// Ticks of a range: at most six ascending multiples of 1, 2, 2.5 or 5 times a power of ten. The labels have the fewest
// digits that distinguish the ticks. If the range is too small, the ticks are its ends.
export function ticksWithin(low, high) {
  const largest = Math.max(Math.abs(low), Math.abs(high)), span = high - low;
  const ends = () => [...new Set([low, high])].map((value) => ({ value, label: formatValue(value) }));
  if (!(span > 1e-8 * largest) || !Number.isFinite(span) || span < 1e-290) return ends();
  for (let exponent = Math.floor(Math.log10(span / kMaxTickCount));; ++exponent) {
    for (const mantissa of [1, 2, 2.5, 5]) {
      // Division by a power of ten gives the double nearest to the decimal number; multiplication by 0.1 does not.
      const multiple = (n) => exponent < 0 ? n * mantissa / 10 ** -exponent : n * mantissa * 10 ** exponent;
      const first = Math.ceil(low / multiple(1) - 1e-9), last = Math.floor(high / multiple(1) + 1e-9);
      if (last - first >= kMaxTickCount) continue;
      const leading = Math.floor(Math.log10(largest)), lastDigit = mantissa === 2.5 ? exponent - 1 : exponent;
      const isScientific = leading < -3 || leading > 5;
      const label = (value) => value === 0 ? '0' : isScientific
        ? shortExponent(value.toExponential(Math.max(0, leading - lastDigit)))
        : value.toFixed(Math.max(0, -lastDigit));
      const ticks = [];
      for (let n = first; n <= last; ++n) ticks.push({ value: multiple(n), label: label(multiple(n)) });
      return ticks;
    }
  }
}
