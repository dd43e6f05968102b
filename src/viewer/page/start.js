import {bytesOfBase64, decodeMesh} from './decode.js';

async function start() {
  const page = JSON.parse(document.getElementById('asdf-vk-page').textContent);
  const streamBytes = (number) => bytesOfBase64(document.getElementById('stream-' + number).textContent);
  const decoded = [];
  for (const mesh of page.meshes) decoded.push(await decodeMesh(mesh, streamBytes));
  document.documentElement.dataset.state = 'ready';
}

start().catch(() => {
  document.documentElement.dataset.state = 'error';
});
