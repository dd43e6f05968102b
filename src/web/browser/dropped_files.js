// Files that the user drops on the page or chooses, with the mesh first.
import { byId } from './elements.js';

const kMeshName = /\.(stl|ply|off|obj|glb|gltf|3mf)(\.gz)?$/i;

/** The files with the first mesh in front; other files are those that it refers to, such as the .bin of a .gltf. */
export function meshFirst(files) {
  const first = files.find(({ name }) => kMeshName.test(name)) ?? files[0];
  return [first, ...files.filter((file) => file !== first)];
}

/** Calls open(files) with an array of File objects. */
export function listenForFiles(open) {
  const chooser = byId('files');
  for (const id of ['choose', 'drop']) byId(id).addEventListener('click', () => chooser.click());
  chooser.addEventListener('change', () => {
    if (chooser.files.length) open(meshFirst([...chooser.files]));
    chooser.value = '';  // So that the same file can be chosen again.
  });
  const mark = (isDragged) => document.body.classList.toggle('dragged', isDragged);
  addEventListener('dragover', (event) => {
    event.preventDefault();
    mark(true);
  });
  addEventListener('dragleave', (event) => mark(Boolean(event.relatedTarget)));
  addEventListener('drop', (event) => {
    event.preventDefault();
    mark(false);
    const files = [...event.dataTransfer.files];
    if (files.length) open(meshFirst(files));
  });
}
