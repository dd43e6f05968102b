import { Controls } from './controls.js';
import { bytesOfBase64, decodeMesh } from './decode.js';
import { LegendPanel } from './legend_ends.js';
import { MeshModel } from './mesh_model.js';
import { Navigation } from './navigation.js';
import { Overlays } from './overlays.js';
import { Picture } from './picture.js';
import { Renderer } from './renderer.js';
import { showReport } from './report.js';
import { fragmentOf, kInitialState, stateOfFragment, Store } from './view_state.js';
import { Viewer } from './viewer.js';
import { Visits } from './visits.js';

const kFragmentMilliseconds = 300;

const arrayBytes = (number) => bytesOfBase64(document.getElementById(`array-${number}`).textContent);

function finish(state, message) {
  document.documentElement.dataset.state = state;
  const element = document.getElementById('message');
  element.textContent = message;
  element.hidden = !message;
  document.getElementById('fallback').hidden = state === 'ready';
  document.getElementById('stage').dataset.view = state;
  for (const form of document.querySelectorAll('.needs-view')) form.hidden = state !== 'ready';
}

// Writes the state to the fragment of the address, and reads it from an address that the user enters.
function followFragment(viewer) {
  let timer, written = location.hash;
  viewer.store.listeners.push(() => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      written = `#${fragmentOf(viewer.state, viewer.initial)}`;
      history.replaceState(null, '', written);
    }, kFragmentMilliseconds);
  });
  addEventListener('hashchange', () => {
    if (location.hash === written) return;
    viewer.flight = null;
    viewer.store.set({ ...viewer.initial, ...viewer.validated(stateOfFragment(location.hash)) });
  });
}

/** Returns the result of read(). If read() fails, throws an error that reports damaged data. */
async function reading(read) {
  try {
    return await read();
  } catch (error) {
    throw new Error(`its data are damaged (${error.message}); write the page again with asdf-vk.`);
  }
}

async function modelsOf(page) {
  const models = [];
  for (const mesh of page.meshes) {
    // The origin is close to the mesh, so that single precision resolves the positions.
    const origin = mesh.boxMin.map((low, axis) => (low + mesh.boxMax[axis]) / 2);
    const thinSurface = mesh.thin?.surface ? await decodeMesh(mesh.thin.surface, arrayBytes, origin) : null;
    models.push(new MeshModel(mesh, origin, await decodeMesh(mesh, arrayBytes, origin), thinSurface));
  }
  // Removes the encoded arrays, which are large and no longer needed.
  for (const array of document.querySelectorAll('[id^=array-]')) array.remove();
  return models;
}

async function start() {
  const page = await reading(() => JSON.parse(document.getElementById('asdf-vk-page').textContent));
  document.getElementById('title').textContent = document.title;
  document.getElementById('generator').textContent = page.generator;
  showReport(page, null);
  const canvas = document.getElementById('view'), renderer = Renderer.create(canvas);
  if (!renderer) {
    finish('nogl', 'This browser has no WebGL 2. The page shows the picture and the report without the 3D view.');
    return;
  }
  const models = await reading(() => modelsOf(page));
  finish('ready', '');
  const viewer = new Viewer(canvas, renderer, models, new Store({ ...kInitialState }));
  const visits = new Visits(viewer);
  showReport(page, visits);
  const legendPanel = new LegendPanel(viewer, document.getElementById('legend'));
  new Overlays(viewer, document.getElementById('overlays'));
  const navigation = new Navigation(viewer);
  new Controls(viewer, navigation, visits, new Picture(viewer, legendPanel));
  followFragment(viewer);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => viewer.requestFrame());
  canvas.addEventListener('webglcontextlost', () => finish('lost', 'The graphics card was lost; waiting for it.'));
  canvas.addEventListener('webglcontextrestored', () => finish('ready', ''));
  canvas.setAttribute('aria-label', `3D view of ${models.map(({ description }) => description.label).join(' and ')}`);
  viewer.requestFrame();
}

start().catch((error) => finish('error', `The page cannot show its mesh: ${error.message}`));
