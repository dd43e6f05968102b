import { bytesOfBase64 } from './decode.js';
import { byId } from './elements.js';
import { finish, modelsOf, PageView, showTexts } from './page_view.js';
import { fragmentOf, stateOfFragment } from './view_state.js';

const kFragmentMilliseconds = 300;

const arrayBytes = (number) => bytesOfBase64(byId(`array-${number}`).textContent);

// Reads the state from the fragment of the address, also if the user changes it, and writes the state to it.
function followFragment(viewer) {
  const read = () => viewer.store.set({ ...viewer.initial, ...viewer.validated(stateOfFragment(location.hash)) });
  let timer, written = location.hash;
  read();
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
    read();
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

async function start() {
  const { meshes, generator } = await reading(() => JSON.parse(byId('asdf-vk-page').textContent));
  byId('generator').textContent = generator;
  showTexts(meshes, null);
  const view = PageView.create();
  if (!view) {
    finish('nogl', 'This browser has no WebGL 2. The page shows the picture and the report without the 3D view.');
    byId('more').hidden = false;
    return;
  }
  const models = await reading(() => modelsOf(meshes, arrayBytes));
  // Removes the encoded arrays, which are large and no longer needed.
  for (const array of document.querySelectorAll('[id^=array-]')) array.remove();
  view.show(models);
  followFragment(view.viewer);
}

start().catch((error) => finish('error', `The page cannot show its mesh: ${error.message}`));
