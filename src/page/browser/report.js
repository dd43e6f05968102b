// Thin regions, summary, warnings and parts as tables and lists. With a viewer, a click on a row moves the view to the
// place of the row.
import { made } from './controls.js';
import { formatCount, formatShare, formatValue } from './format.js';

const kFirstRowCount = 20;

const list = (title, lines, className) => lines?.length
  ? [made('h4', {}, title), made('ul', { className }, ...lines.map((line) => made('li', {}, line)))] : [];

/** rows: arrays of cells. A long table first shows kFirstRowCount rows and a button for the others. */
function table(caption, heads, rows) {
  const body = made('tbody', {}), show = (some) => body.append(...some.map((cells) => {
    const [first, ...others] = cells;
    return made('tr', {}, made('th', { scope: 'row' }, first), ...others.map((cell) => made('td', {}, cell)));
  }));
  show(rows.slice(0, kFirstRowCount));
  const head = made('tr', {}, ...heads.map((text) => made('th', { scope: 'col' }, text)));
  const element = made('table', {}, made('caption', {}, caption), made('thead', {}, head), body);
  if (rows.length <= kFirstRowCount) return [element];
  const more = made('button', { type: 'button' }, `Show all ${formatCount(rows.length)} rows`);
  more.addEventListener('click', () => {
    show(rows.slice(kFirstRowCount));
    more.remove();
  });
  return [element, more];
}

/** A button that calls `action`; the text alone if there is no action. */
function link(text, id, action) {
  if (!action) return text;
  const button = made('button', { type: 'button', id }, text);
  button.addEventListener('click', action);
  return button;
}

// Captions of the lists of thin regions and voids.
const kKinds = { wall: 'Walls, thinnest first', gap: 'Gaps, narrowest first', detail: 'Details', edge: 'Edges', void: 'Sealed voids' };

/** The verdict of a result, its thin regions (walls, gaps, details, edges) and its voids. */
function thinReport(mesh, index, hasOthers, visits) {
  const { limit, verdict, sentence, regions, countsDetails, countsEdges } = mesh.thin;
  const counts = { wall: true, gap: true, detail: countsDetails, edge: countsEdges, void: true };
  const [word, ...rest] = sentence.split(':');
  const row = (region, i) => {
    const value = link(formatValue(region.value, limit), `thin-${index}-${i}`, visits && (() => visits.region(index, i)));
    if (region.kind === 'void') return [value, region.bodies.join(', ')];
    const area = `${formatValue(region.area)} (${formatShare(region.areaShare)})`, count = formatCount(region.faceCount);
    if (region.kind === 'edge') return [value, `${formatValue(region.angleDegrees)}°`, formatValue(region.width), area, count];
    return [value, formatValue(region.least, limit), area, count, ...(region.kind === 'gap' ? [region.bodies.join(' and ')] : []),
      ...(region.change ? [region.change] : [])];
  };
  const list = (kind) => {
    const rows = regions.flatMap((region, i) => region.kind === kind ? [row(region, i)] : []);
    const isCompared = regions.some((region) => region.kind === kind && region.change);
    const heads = kind === 'void' ? ['volume', 'loose bodies'] : kind === 'edge' ? ['least', 'angle', 'width', 'thin area', 'faces']
      : kind === 'gap' ? ['width', 'least beside it', 'area', 'faces', 'bodies'] : ['thickness', 'least beside it', 'thin area', 'faces'];
    if (isCompared && kind !== 'edge') heads.push('compared');
    return rows.length ? table(kKinds[kind] + (counts[kind] ? '' : ', not counted'), heads, rows) : [];
  };
  return [
    ...(hasOthers ? [made('h3', {}, mesh.label || mesh.name)] : []),
    made('p', { className: `verdict ${verdict}`, id: `verdict-${index}` }, made('strong', {}, word), `:${rest.join(':')}`),
    ...Object.keys(kKinds).flatMap(list)];
}

function meshReport(mesh, index, isOpen, visits) {
  const parts = (mesh.segments ?? []).map((part, i) => [
    link(String(part.label), `part-${index}-${i}`, visits && (() => visits.part(index, part))),
    formatValue(part.median), formatCount(part.faceCount), formatValue(part.area)]);
  const summary = made('table', { id: `summary-${index}` }, made('caption', {}, 'Summary'), made('tbody', {},
    ...mesh.summary.map(({ title, value }) => made('tr', {}, made('th', { scope: 'row' }, title), made('td', {}, value)))));
  return made('details', { open: isOpen }, made('summary', {}, made('h3', {}, mesh.label || mesh.name)),
    ...list('Warnings', mesh.warnings, 'warnings'), summary,
    ...(mesh.errorSentence ? [made('p', {}, mesh.errorSentence)] : []),
    ...(parts.length ? table('Parts', ['part', 'median', 'faces', 'area'], parts) : []),
    ...list('Defects of the mesh', mesh.defects));
}

/** visits: a Visits of the viewer; null without a viewer. */
export function showReport(page, visits) {
  const reports = page.meshes.map((mesh, index) => meshReport(mesh, index, page.meshes.length < 3, visits));
  document.getElementById('meshes').replaceChildren(...reports);
  const thin = page.meshes.flatMap((mesh, index) => mesh.thin ? thinReport(mesh, index, page.meshes.length > 1, visits) : []);
  const section = document.getElementById('thin-places');
  section.hidden = !thin.length;
  section.replaceChildren(...thin);
}
