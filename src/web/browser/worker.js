// The worker of engine.js: calls the functions of the WebAssembly module (src/web/wasm/entry_points.cpp). The build puts the
// loader of Emscripten, with the function makeModule(), before this file.

let wasm = null;

const kProgressMilliseconds = 50;

function textArgument(text) {
  return text === null ? 0 : wasm.stringToNewUTF8(text);
}

/** Calls a function with texts, and returns its result. Throws its failure. */
function answerOf(name, ...texts) {
  const parameters = texts.map(textArgument);
  const answer = JSON.parse(wasm.UTF8ToString(wasm[`_${name}`](...parameters)));
  parameters.forEach((parameter) => wasm._free(parameter));
  if (answer.error) throw answer.error;
  return answer.result;
}

function resultsOf({ report, data, arrayCount }) {
  const arrays = Array.from({ length: arrayCount }, (none, number) => {
    const begin = wasm._arrayBytes(number) >>> 0;
    return wasm.HEAPU8.slice(begin, begin + wasm._arraySize(number));
  });
  return { report, page: { data, arrays } };
}

const calls = {
  /** Errors name the file without a folder: it is in the current folder, with the files beside it. */
  open(files, unit) {
    const folder = '/mesh';
    wasm.FS.mkdir(folder);
    wasm.FS.chdir(folder);
    for (const { name, bytes } of files) {
      const steps = name.split('/');
      for (let i = 1; i < steps.length; ++i) wasm.FS.mkdirTree(steps.slice(0, i).join('/'));
      wasm.FS.writeFile(name, bytes, { canOwn: true });
    }
    try {
      return answerOf('openMesh', files[0].name, unit);
    } finally {
      wasm.FS.chdir('/');
      removeFolder(folder);
    }
  },
  check: (options) => resultsOf(answerOf('checkMesh', JSON.stringify(options))),
  compute: (options) => resultsOf(answerOf('computeMesh', JSON.stringify(options))),
  save(format) {
    const file = `/result.${format}`;
    answerOf('saveResult', file);
    const bytes = wasm.FS.readFile(file);
    wasm.FS.unlink(file);
    return bytes;
  },
};

function removeFolder(folder) {
  for (const name of wasm.FS.readdir(folder)) {
    if (name === '.' || name === '..') continue;
    const path = `${folder}/${name}`;
    if (wasm.FS.isDir(wasm.FS.stat(path).mode)) removeFolder(path);
    else wasm.FS.unlink(path);
  }
  wasm.FS.rmdir(folder);
}

function buffersOf(result) {
  if (result instanceof Uint8Array) return [result.buffer];
  return result.page ? result.page.arrays.map((bytes) => bytes.buffer) : [];
}

async function start(compiled) {
  let last = 0;
  wasm = await makeModule({
    instantiateWasm(imports, receive) {
      WebAssembly.instantiate(compiled, imports).then((instance) => receive(instance, compiled));
      return {};
    },
    onProgress(fraction) {
      const now = performance.now();
      if (now - last < kProgressMilliseconds) return;
      last = now;
      postMessage({ progress: fraction });
    },
  });
}

let started = null;

onmessage = async ({ data: { name, parameters } }) => {
  if (name === 'start') {
    started = start(...parameters);
    return;
  }
  await started;
  const answer = {};
  try {
    answer.result = calls[name](...parameters);
  } catch (error) {
    const isFatal = error instanceof Error;  // The module has ended, for example by a trap.
    answer.error = isFatal
      ? { isFatal, code: 'internal', message: `internal error: ${error.message}; please report it` }
      : error;
  }
  answer.memoryBytes = wasm.HEAPU8.length;
  postMessage(answer, answer.result ? buffersOf(answer.result) : []);
};
