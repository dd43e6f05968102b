// The whole view of a page: loads results and shows them in the view, the tabs and the report. A page shows one result
// after another with one PageView.
import { Controls } from './controls.js';
import { decodeMesh } from './decode.js';
import { byId, made } from './elements.js';
import { LegendPanel } from './legend_ends.js';
import { showLists } from './lists.js';
import { MeshModel } from './mesh_model.js';
import { Navigation } from './navigation.js';
import { Overlays } from './overlays.js';
import { Picture } from './picture.js';
import { Renderer } from './renderer.js';
import { showReport } from './report.js';
import { Tabs } from './tabs.js';
import { verdictOf } from './verdict.js';
import { kInitialState, Store } from './view_state.js';
import { Viewer } from './viewer.js';
import { Visits } from './visits.js';

/** Sets the state of the document, and the message over the view. */
export function finish(state, message) {
  document.documentElement.dataset.state = state;
  byId('message').textContent = message;
  byId('message').hidden = !message;
  byId('fallback').hidden = state === 'ready';
  byId('stage').dataset.view = state;
  for (const form of document.querySelectorAll('.needs-view')) form.hidden = state !== 'ready';
}

/** The unit of the lengths of the results, with a space before it; empty without one. */
export function unitOf(meshes) {
  const [unit] = meshes.flatMap(({ fields }) => fields.map((field) => field.unit)).filter((name) => /^(.m|m|in|ft)$/.test(name));
  return unit ? ` ${unit}` : '';
}

export function showVerdict(meshes) {
  const { verdict, word, sentence, details } = verdictOf(meshes, unitOf(meshes));
  byId('headline').className = verdict;
  byId('headline').replaceChildren(...(word ? [made('strong', {}, word), ' '] : []), sentence);
  byId('details').textContent = details.join(' · ');
}

/** The models of a page. arrayBytes(number): as for decodeMesh(). */
export async function modelsOf(meshes, arrayBytes) {
  const models = [];
  for (const mesh of meshes) {
    // The origin is close to the mesh, so that single precision resolves the positions.
    const origin = mesh.boxMin.map((low, axis) => (low + mesh.boxMax[axis]) / 2);
    const thinSurface = mesh.thin?.surface ? await decodeMesh(mesh.thin.surface, arrayBytes, origin) : null;
    models.push(new MeshModel(mesh, origin, await decodeMesh(mesh, arrayBytes, origin), thinSurface));
  }
  return models;
}

/** Shows the texts of results: verdict, lists and report. visits: null without a viewer. */
export function showTexts(meshes, visits) {
  showVerdict(meshes);
  showLists(meshes, visits, unitOf(meshes));
  showReport(meshes);
}

export class PageView {
  /** Returns null without WebGL 2. */
  static create() {
    const renderer = Renderer.create(byId('view'));
    return renderer && new PageView(renderer);
  }

  constructor(renderer) {
    const canvas = byId('view');
    this.viewer = new Viewer(canvas, renderer, new Store({ ...kInitialState }));
    this.visits = new Visits(this.viewer);
    this.legend = new LegendPanel(this.viewer, byId('legend'));
    this.picture = new Picture(this.viewer, this.legend);
    new Overlays(this.viewer, byId('overlays'), this.visits);
    const navigation = new Navigation(this.viewer);
    byId('inset').addEventListener('click', () => navigation.resetView());
    new Controls(this.viewer, navigation, this.visits, this.picture);
    this.tabs = new Tabs(this.viewer);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.viewer.requestFrame());
    canvas.addEventListener('webglcontextlost', () => finish('lost', 'The graphics card was lost; waiting for it.'));
    canvas.addEventListener('webglcontextrestored', () => finish('ready', ''));
  }

  /** Replaces the shown results. keepsView: as for Viewer.load(). */
  show(models, keepsView = false) {
    const meshes = models.map(({ description }) => description);
    finish('ready', '');
    showTexts(meshes, this.visits);
    byId('view').setAttribute('aria-label', `3D view of ${meshes.map(({ label, name }) => label || name).join(' and ')}`);
    this.viewer.load(models, keepsView);
  }
}
