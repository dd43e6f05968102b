// Verdict, thin regions, summary, warnings and defects of the results, as tables and lists.
import { byId, made, shortened } from './elements.js';
import { formatCount, formatShare, formatValue } from './format.js';

const kFirstRowCount = 20;

const list = (title, lines, className) => lines?.length
  ? [made('h4', {}, title), made('ul', { className }, ...lines.map((line) => made('li', {}, line)))] : [];

/** rows: arrays of cells. */
function table(caption, heads, rows) {
  const lines = rows.map(([first, ...others]) => made('tr', {}, made('th', { scope: 'row' }, first), ...others.map((cell) => made('td', {}, cell))));
  const head = made('tr', {}, ...heads.map((text) => made('th', { scope: 'col' }, text)));
  const [body, ...more] = shortened(lines, kFirstRowCount, made('tbody', {}), 'rows');
  return [made('table', {}, made('caption', {}, caption), made('thead', {}, head), body), ...more];
}

// Captions of the lists of thin regions and voids.
const kKinds = { wall: 'Walls, thinnest first', gap: 'Gaps, narrowest first', detail: 'Details', edge: 'Edges', void: 'Sealed voids' };

function thinReport({ thin }, index) {
  const { limit, verdict, sentence, regions, countsDetails, countsEdges } = thin;
  const counts = { wall: true, gap: true, detail: countsDetails, edge: countsEdges, void: true };
  const [word, ...rest] = sentence.split(':');
  const row = (region) => {
    const value = formatValue(region.value, limit);
    if (region.kind === 'void') return [value, region.bodies.join(', ')];
    const area = `${formatValue(region.area)} (${formatShare(region.areaShare)})`, count = formatCount(region.faceCount);
    if (region.kind === 'edge') return [value, `${formatValue(region.angleDegrees)}°`, formatValue(region.width), area, count];
    return [value, formatValue(region.least, limit), area, count, ...(region.kind === 'gap' ? [region.bodies.join(' and ')] : []),
      ...(region.change ? [region.change] : [])];
  };
  const places = (kind) => {
    const some = regions.filter((region) => region.kind === kind);
    const heads = kind === 'void' ? ['volume', 'loose bodies'] : kind === 'edge' ? ['least', 'angle', 'width', 'thin area', 'faces']
      : kind === 'gap' ? ['width', 'least beside it', 'area', 'faces', 'bodies'] : ['thickness', 'least beside it', 'thin area', 'faces'];
    if (kind !== 'edge' && some.some(({ change }) => change)) heads.push('compared');
    return some.length ? table(kKinds[kind] + (counts[kind] ? '' : ', not counted'), heads, some.map(row)) : [];
  };
  return [made('p', { className: `verdict ${verdict}`, id: `verdict-${index}` }, made('strong', {}, word), `:${rest.join(':')}`),
    ...Object.keys(kKinds).flatMap(places)];
}

function meshReport(mesh, index, isOpen) {
  const summary = made('table', { id: `summary-${index}` }, made('caption', {}, 'Summary'), made('tbody', {},
    ...mesh.summary.map(({ title, value }) => made('tr', {}, made('th', { scope: 'row' }, title), made('td', {}, value)))));
  return made('details', { open: isOpen }, made('summary', {}, made('h3', {}, mesh.label || mesh.name)),
    ...list('Warnings', mesh.warnings, 'warnings'), ...(mesh.thin ? thinReport(mesh, index) : []), summary,
    ...list('Defects of the mesh', mesh.defects));
}

export function showReport(meshes) {
  byId('meshes').replaceChildren(...meshes.map((mesh, index) => meshReport(mesh, index, meshes.length < 3)));
}
