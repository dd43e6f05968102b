// The lists of the tabs: thin places with the numbers of the callouts, diameters, and parts. A click on a row moves the
// view to its place.
import { colourOfPart, cssColour } from './colour_maps.js';
import { byId, link, made, shortened } from './elements.js';
import { formatCount, formatShare, formatValue } from './format.js';
import { isCounted, placesOf } from './thin_places.js';

const kFirstPlaceCount = 8;
const kUncountedKinds = { detail: 'details', edge: 'sharp edges' };

const heading = (mesh, hasOthers) => hasOthers ? [made('h3', {}, mesh.label || mesh.name)] : [];

function placeText(region, unit) {
  if (region.kind === 'void') return `sealed void, volume ${formatValue(region.value)}`;
  const words = [...(['wall', 'gap'].includes(region.kind) ? [] : [region.kind]), ...(region.bodies?.length ? [`of ${region.bodies.join(' and ')}`] : []), ...(region.change ? [region.change] : [])];
  if (region.kind === 'edge') words.push(`${formatValue(region.angleDegrees)}°`);
  if (region.areaShare > 0) words.push(`${formatShare(region.areaShare)} of the surface`);
  else if (region.areaShare === undefined) words.push(`the ${region.kind === 'gap' ? 'narrowest gap' : 'thinnest wall'}`);
  return `${unit ? `${unit.trim()} · ` : ''}${words.join(' · ')}`;
}

/** The places of a result. visits: null without a viewer. */
function placeList(mesh, index, hasOthers, visits, unit) {
  const { thin } = mesh, limit = thin?.limit;
  const row = ({ region, index: i }, number) => made('li', { className: 'row' }, link(
    { id: `thin-${index}-${i}`, className: region === mesh.least ? 'place least' : number ? 'place' : 'place uncounted' },
    visits && (() => visits.place(index, i)), ...(number ? [made('b', {}, number)] : []),
    made('strong', {}, region.kind === 'void' ? 'void' : formatValue(region.value, limit)), made('small', {}, placeText(region, unit))));
  const places = placesOf({ thin, description: mesh });
  const counted = shortened(places.map((place, i) => row(place, i + 1)), kFirstPlaceCount, made('ol', { className: 'rows' }), 'places');
  const others = Object.keys(kUncountedKinds).flatMap((kind) => {
    const rows = (thin?.regions ?? []).flatMap((region, i) => region.kind === kind && !isCounted(thin, region) ? [row({ region, index: i })] : []);
    return rows.length ? [made('details', { className: 'uncounted' }, made('summary', {}, `${formatCount(rows.length)} ${rows.length === 1 ? kUncountedKinds[kind].slice(0, -1) : kUncountedKinds[kind]}, not counted`),
      ...shortened(rows, kFirstPlaceCount, made('ol', { className: 'rows' }), kUncountedKinds[kind]))] : [];
  });
  return [...heading(mesh, hasOthers), ...(places.length ? counted : [made('p', { className: 'hint' }, thin ? `Nothing is ${thin.title}.` : 'No wall was found.')]), ...others];
}

function diameterList(mesh, hasOthers) {
  const rows = mesh.summary.filter(({ title }) => ['Diameter', 'Spread', 'Thickness', 'Change'].includes(title));
  return [...heading(mesh, hasOthers), made('dl', {}, ...rows.flatMap(({ title, value }) => [made('dt', {}, title), made('dd', {}, value)])),
    ...(mesh.errorSentence ? [made('p', { className: 'hint' }, mesh.errorSentence)] : [])];
}

function partList(mesh, index, hasOthers, visits) {
  const parts = mesh.segments ?? [], total = parts.reduce((sum, { area }) => sum + area, 0);
  const rows = parts.map((part, i) => {
    const swatch = made('i', {});
    swatch.style.background = cssColour(colourOfPart(part.label));
    return made('li', { className: 'row' }, link({ id: `part-${index}-${i}`, className: 'place' }, visits && (() => visits.part(index, part)), swatch,
      made('strong', {}, String(part.label)), made('small', {}, `${formatShare(part.area / total)}${part.median === null ? ' of the surface' : ` · diameter ${formatValue(part.median)}`}`)));
  });
  return rows.length ? [...heading(mesh, hasOthers), ...shortened(rows, 50, made('ol', { className: 'rows' }), 'parts')] : [];
}

/** Fills the lists of all tabs. visits: a Visits of the viewer; null without a viewer. */
export function showLists(meshes, visits, unit) {
  const hasOthers = meshes.length > 1, each = (list) => meshes.flatMap((mesh, index) => list(mesh, index));
  byId('walls-list').replaceChildren(...each((mesh, index) => mesh.thin || mesh.least ? placeList(mesh, index, hasOthers, visits, unit) : []));
  byId('diameter-list').replaceChildren(...each((mesh) => diameterList(mesh, hasOthers)));
  byId('parts-list').replaceChildren(...each((mesh, index) => partList(mesh, index, hasOthers, visits)));
}

/** Marks the row of the selected place or part. */
export function markRow({ place, part }, meshes) {
  const [mesh, label] = (part ?? ':').split(':'), row = meshes[mesh]?.segments?.findIndex((one) => one.label === Number(label));
  const selected = [place && `thin-${place.replace(':', '-')}`, part && `part-${mesh}-${row}`];
  for (const button of document.querySelectorAll('.place')) button.setAttribute('aria-current', String(selected.includes(button.id)));
}
