// The comparison with a limit of the thickness: what is shown as thin, and where its regions are seen best.
import { formatValue } from './format.js';
import { countHits } from './picking.js';
import { add, cross, dot, scaled, subtract, unit } from './vectors.js';

const kField = 'least_thickness', kMarkerCount = 8;

/** The limit that the results of the page were compared with, or null. */
export const givenLimit = (models) => models.find((model) => model.thin)?.thin.limit ?? null;

/**
 * What a state shows as thin, or null: {limit, isGiven, name}. isGiven: the exact surface of each result; otherwise the
 * faces whose value of the field `name` is below the limit.
 */
export function thinShown(state, look, layers) {
  if (!state.thin) return null;
  const given = givenLimit(layers.models), name = given !== null && layers.has(kField) ? kField : look.name;
  if (given !== null && (state.thinAt === null || state.thinAt === given)) return { limit: given, isGiven: true, name };
  if (name === look.name && look.kind !== 'number') return null;
  return { limit: state.thinAt ?? look.low, isGiven: false, name };
}

/** Share of the area of the meshes in view that is thin. */
export function thinShare({ thin, look, layers, models }) {
  if (!thin.isGiven) {
    const { area, total } = layers.below(look, thin.name, thin.limit);
    return total > 0 ? area / total : 0;
  }
  const sum = (measure) => look.panes.reduce((total, { index }) => total + measure(models[index]), 0);
  return sum((model) => model.thin?.surface.totalArea ?? 0) / (sum((model) => model.totalArea) || 1);
}

/** The value of a region in words. */
export const regionValue = (region, limit) => region.isSharp ? 'sharp' : formatValue(region.value, limit);

/** The regions whose least places are marked in the view. */
export const markedRegions = (model) => model.thin?.regions.slice(0, kMarkerCount) ?? [];

/** Radius of a region around a point; regions: per triangle. */
export function regionRadius(surface, regions, region, point) {
  let radius = 0;
  for (let face = 0; face < surface.faceCount; ++face) {
    if (regions[face] !== region) continue;
    for (let corner = 0; corner < 3; ++corner)
      radius = Math.max(radius, Math.hypot(...subtract(surface.corner(face, corner), point)));
  }
  return radius;
}

/**
 * Direction to the viewer from which the fewest faces hide one of the two points of a region, which are `outward` from
 * each other; of equal ones the closest to `preferred`. Oblique, so that the wall is seen beside its surface.
 */
export function directionOfLeastCover(model, ends, outward, preferred, least) {
  const side = unit(cross(outward, Math.abs(outward[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]), [0, 0, 1]);
  const other = cross(outward, side);
  const candidates = [[ends[0], outward], [ends[1], scaled(outward, -1)]].flatMap(([end, towards]) =>
    [side, other].flatMap((tilt) => [0.7, -0.7].map((share) => ({ end, direction: unit(add(towards, scaled(tilt, share)), towards) }))));
  const scored = candidates.map(({ end, direction }) =>
    ({ direction, score: countHits(model, end, direction, least) - 0.4 * dot(direction, preferred) }));
  return scored.reduce((best, one) => one.score < best.score ? one : best).direction;
}
