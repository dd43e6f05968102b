// Comparison with a limit of the thickness: the faces that are shown as thin, and the best view of a thin region.
import { formatValue } from './format.js';
import { countHits } from './picking.js';
import { add, dot, scaled, subtract } from './vectors.js';

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

/** Share of the area of the visible meshes that is thin and counts. */
export function thinShare({ thin, look, layers, models }) {
  if (!thin.isGiven) {
    const { area, total } = layers.below(look, thin.name, thin.limit);
    return total > 0 ? area / total : 0;
  }
  const sum = (measure) => look.panes.reduce((total, { index }) => total + measure(models[index]), 0);
  return sum((model) => model.thin?.area ?? 0) / (sum((model) => model.totalArea) || 1);
}

/** Whether a thin region counts for the verdict. */
export const isCounted = ({ countsDetails, countsEdges }, { kind }) =>
  kind === 'detail' ? countsDetails : kind === 'edge' ? countsEdges : true;

/** Whether a visible mesh has thin regions that do not count. */
export const hasUncounted = ({ look, models }) =>
  look.panes.some(({ index }) => models[index].thin?.regions.some((region) => !isCounted(models[index].thin, region)));

// The numbered places of a model: the regions that count, thinnest first. If nothing is too thin, the first place is
// the least wall. A place is {region, index}; the least wall has the index -1.
export function placesOf(model) {
  const { thin, description: { least } } = model;
  const places = (thin?.regions ?? []).map((region, index) => ({ region, index })).filter(({ region }) => isCounted(thin, region));
  const isThin = places.some(({ region }) => region.kind !== 'void');
  return isThin || !least ? places : [{ region: least, index: -1 }, ...places];
}

/** The place with an index of placesOf(); undefined if there is none. */
export const placeAt = (model, index) => index < 0 ? placesOf(model).find((place) => place.index < 0)
  : model.thin?.regions[index] && { region: model.thin.regions[index], index };

/** The least thickness of a region as a text; walls and gaps have no word. */
export const regionValue = (region, limit) => `${region.kind === 'wall' || region.kind === 'gap' ? '' : `${region.kind} `}${formatValue(region.value, limit)}`;

/** The places that are marked in the view, with their numbers. */
export const markedPlaces = (model) => placesOf(model).slice(0, kMarkerCount);

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

// Direction to the viewer from which the fewest faces hide one end of a wall, close to the present direction. ends: the
// two points of the region. outward: unit vector from the second end to the first. axes: those of the view, of which the
// upright one stays upright. All candidates are oblique to the wall, so that its thickness is visible, if possible.
// least: hits at a smaller distance are ignored.
export function directionOfLeastCover(model, ends, outward, axes, least) {
  const { toViewer, upright: [side, up, front] } = axes, candidates = [toViewer];
  for (const [height, count] of [[0.45, 8], [-0.3, 4], [0.85, 4]]) {
    for (let i = 0; i < count; ++i) {
      const angle = 2 * Math.PI * (i + 0.4) / count, level = add(scaled(front, Math.cos(angle)), scaled(side, Math.sin(angle)));
      candidates.push(add(scaled(level, Math.sqrt(1 - height * height)), scaled(up, height)));
    }
  }
  let best = { score: Infinity };
  for (const direction of candidates) {
    const along = dot(direction, outward), oblique = Math.max(Math.abs(along) - 0.85, 0.25 - Math.abs(along), 0);
    const hits = countHits(model, ends[along < 0 ? 1 : 0], direction, least);
    const score = hits + 3 * oblique - 0.7 * dot(direction, toViewer) - 0.2 * dot(direction, up);
    if (score < best.score) best = { score, direction };
  }
  return best.direction;
}
