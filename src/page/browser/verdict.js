// The verdict of the page in one sentence, with the least thickness and the limit.
import { formatCount, formatShare, formatValue } from './format.js';
import { isCounted } from './thin_places.js';

export const kWords = { passed: 'PASS', failed: 'FAIL', notJudged: 'NOT JUDGED' };
const kSubjects = { wall: 'thinnest wall', gap: 'narrowest gap', detail: 'thinnest detail', edge: 'thinnest edge' };
const kNouns = { wall: 'wall', gap: 'gap', detail: 'detail', edge: 'edge' };

const capital = (text) => text[0].toUpperCase() + text.slice(1);

const counted = (count, noun) => `${formatCount(count)} ${noun}${count === 1 ? '' : 's'}`;

/** The sentence of a result that was compared with a limit. unit: as Viewer.unit. */
function comparedSentence({ thin, least: given }, unit) {
  const least = given ?? thin.regions.find((region) => kNouns[region.kind] && isCounted(thin, region));
  if (thin.verdict === 'notJudged') return `${capital(thin.sentence.split(': ').slice(1).join(': '))}.`;
  if (!least) return `Nothing is ${thin.title}${unit}.`;
  const value = formatValue(least.value, thin.limit);
  return `The ${kSubjects[least.kind]} is ${value}${unit}, the limit ${formatValue(thin.limit)}${unit}.`;
}

/** Counts of the places that are too thin. */
function comparedDetails({ thin }) {
  const places = thin.regions.filter((region) => isCounted(thin, region) && kNouns[region.kind]);
  const kinds = Object.keys(kNouns).filter((kind) => places.some((region) => region.kind === kind));
  const texts = kinds.map((kind) => counted(places.filter((region) => region.kind === kind).length, kNouns[kind]));
  if (!texts.length) return [];
  const share = places.reduce((sum, { areaShare }) => sum + areaShare, 0);
  return [`${texts.join(' and ')} ${thin.title}`, ...(share > 0 ? [`${formatShare(share)} of the surface`] : [])];
}

const summaryValue = (mesh, title) => mesh.summary.find((row) => row.title === title)?.value;

/** {verdict, word, sentence, details} of a page. verdict: a key of kWords, or empty without a limit. */
export function verdictOf(meshes, unit) {
  const compared = meshes.filter(({ thin }) => thin), [first] = meshes;
  const names = [...new Set(meshes.map(({ name }) => name))].join(', ');
  if (compared.length > 1) {
    const failed = compared.filter(({ thin }) => thin.verdict === 'failed').length;
    const verdict = ['failed', 'notJudged', 'passed'].find((one) => compared.some(({ thin }) => thin.verdict === one));
    const sentence = failed ? `${failed} of ${compared.length} meshes ${failed > 1 ? 'are' : 'is'} too thin, the limit ${formatValue(compared[0].thin.limit)}${unit}.`
      : verdict === 'passed' ? `No mesh is ${compared[0].thin.title}${unit}.` : 'Some meshes could not be judged.';
    return { verdict, word: kWords[verdict], sentence, details: [names] };
  }
  if (compared.length) {
    const [mesh] = compared, { verdict } = mesh.thin, unjudged = verdict === 'notJudged' ? summaryValue(mesh, 'Unjudged') : null;
    const details = [...(unjudged ? [unjudged] : comparedDetails(mesh)), names];
    return { verdict, word: kWords[verdict], sentence: comparedSentence(mesh, unit), details };
  }
  const of = meshes.length > 1 ? `${meshes.length} meshes` : names;
  if (meshes.length > 1) return { verdict: '', word: '', sentence: of, details: [names] };
  const diameter = summaryValue(first, 'Diameter');
  if (first.segments?.length) return { verdict: '', word: '', sentence: `${counted(first.segments.length, 'part')}.`, details: [...(diameter ? [`diameter ${diameter}${unit}`] : []), of] };
  if (first.least) return { verdict: '', word: '', sentence: `The ${kSubjects[first.least.kind]} is ${formatValue(first.least.value)}${unit}.`, details: [of] };
  return { verdict: '', word: '', sentence: diameter ? `Shape diameter ${diameter}${unit}.` : of, details: diameter ? [of] : [] };
}
