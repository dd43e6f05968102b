// The part that the page checks: keeps the files, opens them in the engine when needed, and asks for results. A task that
// is replaced by a newer one ends with an error whose code is 'cancelled'.
import { showWork } from './work.js';

export class Checker {
  constructor(engine) {
    Object.assign(this, { engine, files: [], unit: '', mesh: null, limit: '0.8', isBusy: false, onSlow: () => {}, hasCheck: false, hasParts: false });
  }

  get name() {
    return this.files[0]?.name ?? '';
  }

  /** The limit as an argument of the engine: millimetres, or units of a file that states none. */
  limitArgument() {
    const text = this.limit.trim().replace(',', '.'), isNumber = text !== '' && Number.isFinite(Number(text));
    return !isNumber ? text : this.mesh.unit ? `${text}mm` : Number(text);
  }

  async run(name, call) {
    if (this.isBusy) await this.cancel();
    this.isBusy = true;
    try {
      return await showWork(name, call, () => this.onSlow(name));
    } finally {
      this.isBusy = false;
    }
  }

  /** Ends the running call. The mesh must be opened again. */
  async cancel() {
    this.mesh = null;
    await this.engine.cancel();
  }

  /** files: an array of {name, bytes}. */
  setFiles(files) {
    Object.assign(this, { files, mesh: null, hasParts: false });
  }

  async open(onProgress) {
    if (this.mesh) return;
    this.mesh = await this.engine.open(this.files, this.unit ? { unit: this.unit } : {}, onProgress);
    this.hasCheck = false;
  }

  /** The walls at the limit. */
  check() {
    return this.run(`Checking ${this.name}`, async (onProgress) => {
      await this.open(onProgress);
      const result = await this.engine.check({ limit: this.limitArgument() }, onProgress);
      this.hasCheck = true;
      return result;
    });
  }

  /** The diameters; with isSegmented also the parts. */
  compute(isSegmented) {
    return this.run(`${isSegmented ? 'Parts' : 'Diameters'} of ${this.name}`, async (onProgress) => {
      await this.open(onProgress);
      if (!this.hasCheck) await this.engine.check({ limit: this.limitArgument() }, onProgress);
      this.hasCheck = true;
      this.hasParts ||= isSegmented;
      return this.engine.compute(this.hasParts ? { segment: true } : {}, onProgress);
    });
  }
}
