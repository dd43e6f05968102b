// The library in a worker, for pages and tests. The worker is made from a blob, so that a page works from file://.
//
//   const engine = await startEngine();
//   const mesh = await engine.open(files, { unit }, onProgress);
//     files: [{ name, bytes }] (ArrayBuffer or Uint8Array; copied), the mesh first, then the files that it refers to, such
//     as the .bin of a .gltf. unit: '', 'um', 'mm', 'cm', 'm', 'in' or 'ft' replaces the unit that the file states.
//     mesh: { name, faceCount, triangleCount, vertexCount, unit, skipped }; unit is '' if the file states none.
//   const walls = await engine.check({ limit }, onProgress);
//     The wall thickness and its verdict at a limit, a number in the unit of the mesh or a text such as '0.8mm'. A further
//     check with another limit does not prepare the mesh again.
//   const result = await engine.compute({ segment: true }, onProgress);
//     The shape diameters; with `segment` also the parts. The result has the last check, too, until another mesh is opened.
//     Both calls also take options of the JSON report by name: { seeds: '10%', countDetails: true, closerThan: 0.3 }.
//     walls, result: { report, page: { data, arrays } }. report: the JSON report (docs/schema.json). data: the JSON of a
//     page of results; arrays[n]: a Uint8Array, the bytes of its array n (docs/page-format.md).
//   const bytes = await engine.save('ply');
//     The last result as a file, a Uint8Array: 'json', 'html' (a page of results) or a format of docs/formats.md.
//   await engine.cancel();
//     Ends the worker and starts another one. The pending call fails with the code 'cancelled'. The mesh must be opened
//     again.
//
// onProgress(fraction) is called with 0 to 1. A call begins when the call before has ended. A call that fails rejects
// with an Error: message is the sentence of the program, with a remedy if there is one; code is the code of a failure in
// docs/formats.md, for example 'unreadableInput'.

import { bytesOfBase64 } from '../../page/browser/decode.js';

async function unpackedElement(id) {
  const packed = bytesOfBase64(document.getElementById(id).textContent);
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate')));
}

// The memory of WebAssembly never shrinks: a worker with more memory is replaced before it reads the next mesh.
const kMaxKeptBytes = 2 ** 28;

function failure(code, message) {
  return Object.assign(new Error(message), { code });
}

class Engine {
  #makeWorker;
  #worker = null;
  #last = Promise.resolve();  // Settles when the last call has ended.
  #pending = null;            // { resolve, reject, onProgress } of the call that the worker runs.
  #memoryBytes = 0;

  /** makeWorker(): returns the promise of an object with postMessage(), terminate(), onmessage and onerror. */
  constructor(makeWorker) {
    this.#makeWorker = makeWorker;
  }

  async start() {
    const worker = await this.#makeWorker();
    worker.onmessage = ({ data }) => this.#receive(data);
    worker.onerror = () => {
      this.#stop();
      this.#settle(failure('internal', 'internal error: the worker ended; please report it'));
    };
    this.#worker = worker;
    this.#memoryBytes = 0;
  }

  open(files, { unit = null } = {}, onProgress = null) {
    const sent = files.map(({ name, bytes }) => ({ name, bytes: new Uint8Array(bytes) }));
    return this.#call('open', [sent, unit], onProgress, async () => {
      if (this.#memoryBytes > kMaxKeptBytes) this.#stop();
    });
  }

  check({ limit, ...options }, onProgress = null) {
    return this.#call('check', [{ failIfThinner: limit, ...options }], onProgress);
  }

  compute(options = {}, onProgress = null) {
    const { segment, ...others } = options;
    if (segment) others.segment = segment === true ? 'parts' : segment;
    return this.#call('compute', [others], onProgress);
  }

  save(format) {
    return this.#call('save', [format], null);
  }

  async cancel() {
    this.#stop();
    this.#settle(failure('cancelled', 'cancelled'));
    await this.#last;
    if (!this.#worker) await this.start();
  }

  #call(name, parameters, onProgress, before = async () => {}) {
    const ended = this.#last.then(async () => {
      await before();
      if (!this.#worker) await this.start();
      return new Promise((resolve, reject) => {
        this.#pending = { resolve, reject, onProgress };
        this.#worker.postMessage({ name, parameters });
      });
    });
    this.#last = ended.catch(() => {});
    return ended;
  }

  #receive({ progress, memoryBytes, error, result }) {
    if (progress !== undefined) {
      this.#pending?.onProgress?.(progress);
      return;
    }
    this.#memoryBytes = memoryBytes;
    if (error?.isFatal) this.#stop();
    this.#settle(error ? failure(error.code, error.message) : null, result);
  }

  #settle(error, result) {
    const pending = this.#pending;
    this.#pending = null;
    if (error) pending?.reject(error);
    else pending?.resolve(result);
  }

  #stop() {
    this.#worker?.terminate();
    this.#worker = null;
  }
}

/** makeWorker: as for Engine; by default a worker of the module and the script in the elements of the page. */
export async function startEngine(makeWorker = null) {
  if (!makeWorker) {
    const [module, script] = await Promise.all([
      unpackedElement('engine-module').then((response) => response.arrayBuffer()).then(WebAssembly.compile),
      unpackedElement('engine-worker').then((response) => response.text())]);
    makeWorker = async () => {
      const address = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
      const worker = new Worker(address);
      URL.revokeObjectURL(address);
      worker.postMessage({ name: 'start', parameters: [module] });
      return worker;
    };
  }
  const engine = new Engine(makeWorker);
  await engine.start();
  return engine;
}
