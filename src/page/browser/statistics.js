// Ranges, histograms and shares of values per face, NaN where there is none, over one or more meshes: each part is
// {values, areas}.

const kBinCount = 65536;

/** {low, high, min, max}: 1st and 99th percentile of the faces, and the ends; null without any value. */
export function rangeOf(parts) {
  let min = Infinity, max = -Infinity, count = 0;
  for (const { values } of parts) {
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      if (value < min) min = value;
      if (value > max) max = value;
    }
  }
  if (min > max) return null;
  const bins = new Uint32Array(kBinCount), scale = max > min ? (kBinCount - 1) / (max - min) : 0;
  for (const { values } of parts) {
    for (let i = 0; i < values.length; ++i) {
      if (values[i] !== values[i]) continue;
      ++bins[Math.round((values[i] - min) * scale)];
      ++count;
    }
  }
  const percentile = (share) => {
    let below = 0, bin = 0;
    while (bin < kBinCount - 1 && below + bins[bin] <= share * (count - 1)) below += bins[bin++];
    return scale > 0 ? min + bin / scale : min;
  };
  const low = percentile(0.01), high = percentile(0.99);
  if (low < high || min === max) return { low, high, min, max };
  // Values far apart: most are in one bin.
  const all = Float32Array.from(parts.flatMap(({ values }) => Array.from(values)).filter((value) => value === value)).sort();
  const at = (share) => all[Math.floor(share * (all.length - 1))];
  return { low: at(0.01), high: at(0.99), min, max };
}

/** Areas of the faces by value in equal bins from low to high, and of those outside; total includes faces of no value. */
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

/** Faces whose value is below the limit. */
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
