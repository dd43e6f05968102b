// The engine of src/web/browser in Node, with the module and the worker of a build folder.

import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { Worker } from 'node:worker_threads';

import { startEngine } from '../../src/web/browser/engine.js';

// What a worker of a browser has, and a worker of Node has not.
const kWorkerOfBrowser = `
  const { parentPort } = require('node:worker_threads');
  globalThis.self = globalThis;
  self.location = { href: '' };
  self.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
  parentPort.on('message', (data) => self.onmessage({ data }));
`;

/** folder: has asdfvk-engine.wasm and engine-worker.js. */
export async function startNodeEngine(folder) {
  const module = await WebAssembly.compile(await readFile(join(folder, 'asdfvk-engine.wasm')));
  const script = kWorkerOfBrowser + await readFile(join(folder, 'engine-worker.js'), 'utf8');
  return startEngine(async () => {
    const worker = new Worker(script, { eval: true });
    const likeInBrowser = {
      postMessage: (message) => worker.postMessage(message),
      terminate: () => worker.terminate(),
    };
    worker.on('message', (data) => likeInBrowser.onmessage({ data }));
    worker.on('error', (error) => { console.error(error); likeInBrowser.onerror(error); });
    likeInBrowser.postMessage({ name: 'start', parameters: [module] });
    return likeInBrowser;
  });
}
