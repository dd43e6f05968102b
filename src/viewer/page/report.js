// Summary, warnings, thin regions and parts as tables and lists. Needs no WebGL; a viewer makes rows fly there.
import { made } from './controls.js';
import { formatCount, formatValue } from './format.js';

const kFirstRowCount = 20;

const list = (title, lines, className) => lines?.length
  ? [made('h4', {}, title), made('ul', { className }, ...lines.map((line) => made('li', {}, line)))] : [];

/** rows: arrays of cells; the rest of a long table follows on request. */
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

/** actions: {face(index, id, area), part(index, part)}, or null without a view. */
function meshReport(mesh, index, isOpen, actions) {
  const link = (text, id, action) => {
    if (!actions) return text;
    const button = made('button', { type: 'button', id }, text);
    button.addEventListener('click', action);
    return button;
  };
  const thin = (mesh.thinRegions ?? []).map((region, i) => [
    link(formatCount(region.face), `thin-${index}-${i}`, () => actions.face(index, region.face, region.area)),
    formatValue(region.value), formatCount(region.faceCount), formatValue(region.area)]);
  const parts = (mesh.segments ?? []).map((part, i) => [
    link(String(part.label), `part-${index}-${i}`, () => actions.part(index, part)),
    formatValue(part.median), formatCount(part.faceCount), formatValue(part.area)]);
  const summary = made('table', { id: `summary-${index}` }, made('caption', {}, 'Summary'), made('tbody', {},
    ...mesh.summary.map(({ title, value }) => made('tr', {}, made('th', { scope: 'row' }, title), made('td', {}, value)))));
  return made('details', { open: isOpen }, made('summary', {}, made('h3', {}, mesh.label || mesh.name)),
    ...list('Warnings', mesh.warnings, 'warnings'), summary,
    ...(mesh.errorSentence ? [made('p', {}, mesh.errorSentence)] : []),
    ...(thin.length ? table('Thin regions, thinnest first', ['thinnest face', 'thickness', 'faces', 'area'], thin) : []),
    ...(parts.length ? table('Parts', ['part', 'median', 'faces', 'area'], parts) : []),
    ...list('Defects of the mesh', mesh.defects));
}

export function showReport(page, actions) {
  const reports = page.meshes.map((mesh, index) => meshReport(mesh, index, page.meshes.length < 3, actions));
  document.getElementById('meshes').replaceChildren(...reports);
}
