// Ranges, histograms and shares of values over meshes. Each part {values, areas} has an entry per face; NaN: no value.

/** Range {low, high, min, max}: 1st percentile, 99th percentile, least and greatest value; null without values. */
export function rangeOf(parts) {
  const all = new Float32Array(parts.reduce((sum, { values }) => sum + values.length, 0));
  let count = 0;
  for (const { values } of parts)
    for (let i = 0; i < values.length; ++i) if (values[i] === values[i]) all[count++] = values[i];
  if (!count) return null;
  const sorted = all.subarray(0, count).sort(), at = (share) => sorted[Math.floor(share * (count - 1))];
  return { low: at(0.01), high: at(0.99), min: at(0), max: at(1) };
}

// Areas of the faces in equal bins from low to high, and the areas below low and above high. total: area of all faces,
// with and without a value.
export function histogramOf(parts, low, high, binCount) {
  const bins = new Float64Array(binCount), scale = high > low ? binCount / (high - low) : 0;
  let below = 0, above = 0, total = 0;
  for (const { values, areas } of parts) {
    for (let i = 0; i < values.length; ++i) {
      const value = values[i], area = areas[i];
      total += area;
      if (value < low) below += area;
      else if (value > high) above += area;
      else if (value === value) bins[Math.min(Math.floor((value - low) * scale), binCount - 1)] += area;
    }
  }
  return { bins, below, above, total };
}

/** Count and area of the faces with a value below the limit, and the total area. */
export function facesBelow(parts, limit) {
  let count = 0, area = 0, total = 0;
  for (const { values, areas } of parts) {
    for (let i = 0; i < values.length; ++i) {
      total += areas[i];
      if (!(values[i] < limit)) continue;
      ++count;
      area += areas[i];
    }
  }
  return { count, area, total };
}
