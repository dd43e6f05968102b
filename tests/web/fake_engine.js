// Replaces engine.js in tests of the page: the results are those of two pages that the program wrote, in the elements
// fake-walls and fake-all. A file whose name begins with "bad" fails, and one that begins with "slow" takes long.
import { bytesOfBase64 } from './decode.js';

const kSlowSteps = 100;

const unpacked = async (id) => new Response(new Blob([bytesOfBase64(document.getElementById(id).textContent)])
  .stream().pipeThrough(new DecompressionStream('deflate'))).json();

class FakeEngine {
  constructor(results) {
    Object.assign(this, { results, calls: [], isCancelled: false });
    window.fakeCalls = this.calls;
  }

  async answer(call, result, onProgress) {
    this.calls.push(call);
    this.isCancelled = false;
    for (let step = 0; this.isSlow && step < kSlowSteps; ++step) {
      onProgress(step / kSlowSteps);
      await new Promise((done) => setTimeout(done, 20));
      if (this.isCancelled) throw Object.assign(new Error('cancelled'), { code: 'cancelled' });
    }
    return result;
  }

  page({ data, arrays }) {
    return { report: {}, page: { data, arrays: arrays.map(bytesOfBase64) } };
  }

  open(files, { unit = '' } = {}, onProgress) {
    const [{ name }] = files;
    this.isSlow = name.startsWith('slow');
    if (name.startsWith('bad')) return Promise.reject(Object.assign(new Error(`${name}: the file ends early`), { code: 'unreadableInput' }));
    return this.answer(['open', files.map((file) => file.name), unit], { name, unit }, onProgress);
  }

  check({ limit }, onProgress) {
    if (!(Number.parseFloat(limit) > 0)) return Promise.reject(new Error(`failIfThinner: '${limit}' is no length`));
    return this.answer(['check', limit], this.page(this.results.walls), onProgress);
  }

  compute(options, onProgress) {
    return this.answer(['compute', options], this.page(this.results.all), onProgress);
  }

  save(format) {
    return this.answer(['save', format], new TextEncoder().encode(format));
  }

  async cancel() {
    this.calls.push(['cancel']);
    this.isCancelled = true;
    await new Promise((done) => setTimeout(done, 50));
  }
}

export const startEngine = async () => new FakeEngine({ walls: await unpacked('fake-walls'), all: await unpacked('fake-all') });
