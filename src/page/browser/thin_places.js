// Comparison with a limit of the thickness: the faces that are shown as thin, and the best view of a thin region.
import { formatValue } from './format.js';
import { countHits } from './picking.js';
import { add, cross, dot, scaled, subtract, unit } from './vectors.js';

const kMarkerCount = 8;

/** The field that is compared with the limit of the results. */
const comparedField = (layers) => ['least_thickness', 'least_gap'].find((name) => layers.has(name));

/** The limit that the results of the page were compared with; null without a limit. */
export const givenLimit = (models) => models.find((model) => model.thin)?.thin.limit ?? null;

// The limit {limit, title, isGiven, name} below which a state shows thin places, or null. If isGiven is true, the view shows
// the exact thin surface of each result. If isGiven is false, the view shows the faces whose value of the field `name`
// is below the limit.
export function thinShown(state, look, layers) {
  if (!state.thin) return null;
  const given = givenLimit(layers.models), name = (given !== null && comparedField(layers)) || look.name;
  const title = layers.models.find((model) => model.thin)?.thin.title;
  if (given !== null && (state.thinAt === null || state.thinAt === given)) return { limit: given, title, isGiven: true, name };
  if (name === look.name && look.kind !== 'number') return null;
  return { limit: state.thinAt ?? look.low, isGiven: false, name };
}

/** Thin share of the area of the visible meshes. */
export function thinShare({ thin, look, layers, models }) {
  if (!thin.isGiven) {
    const { area, total } = layers.below(look, thin.name, thin.limit);
    return total > 0 ? area / total : 0;
  }
  const sum = (measure) => look.panes.reduce((total, { index }) => total + measure(models[index]), 0);
  return sum((model) => model.thin?.surface.totalArea ?? 0) / (sum((model) => model.totalArea) || 1);
}

/** The least thickness of a region as a text; walls and gaps have no word. */
export const regionValue = (region, limit) => `${region.kind === 'wall' || region.kind === 'gap' ? '' : `${region.kind} `}${formatValue(region.value, limit)}`;

/** The regions whose thinnest places are marked in the view. */
export const markedRegions = (model) => model.thin?.regions.slice(0, kMarkerCount) ?? [];

/** Greatest distance of a corner of the region from a point. regions: region of each triangle. */
export function regionRadius(surface, regions, region, point) {
  let radius = 0;
  for (let face = 0; face < surface.faceCount; ++face) {
    if (regions[face] !== region) continue;
    for (let corner = 0; corner < 3; ++corner)
      radius = Math.max(radius, Math.hypot(...subtract(surface.corner(face, corner), point)));
  }
  return radius;
}

// Direction to the viewer from which the fewest faces hide one end of a wall. ends: the two points of the region.
// outward: unit vector from the second end to the first. All candidates are oblique, so that the thickness of the wall
// is visible. Among equal candidates, the one closest to `preferred` is chosen. least: hits at a smaller distance are
// ignored.
export function directionOfLeastCover(model, ends, outward, preferred, least) {
  const side = unit(cross(outward, Math.abs(outward[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]), [0, 0, 1]);
  const other = cross(outward, side);
  const candidates = [[ends[0], outward], [ends[1], scaled(outward, -1)]].flatMap(([end, towards]) =>
    [side, other].flatMap((tilt) => [0.7, -0.7].map((share) => ({ end, direction: unit(add(towards, scaled(tilt, share)), towards) }))));
  const scored = candidates.map(({ end, direction }) =>
    ({ direction, score: countHits(model, end, direction, least) - 0.4 * dot(direction, preferred) }));
  return scored.reduce((best, one) => one.score < best.score ? one : best).direction;
}
