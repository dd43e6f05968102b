// The page that checks parts: files in, verdict and places out. Everything is computed in the page.
import { Checker } from './checker.js';
import { listenForFiles } from './dropped_files.js';
import { byId } from './elements.js';
import { startEngine } from './engine.js';
import { finish, modelsOf, PageView } from './page_view.js';
import { saveFile } from './picture.js';

class WebPage {
  constructor(view, engine) {
    this.view = view;
    this.checker = new Checker(engine);
    this.task = 0;
    this.checker.onSlow = (name) => this.shown || this.clear(`${name} ...`);
    view.tabs.makeMissing = (name) => this.show((checker) => checker.compute(name === 'parts'), () => view.tabs.select(name));
    listenForFiles((files) => this.open(files));
    byId('cancel').addEventListener('click', () => this.checker.cancel());
    byId('limit').addEventListener('change', () => this.judge());
    byId('unit').addEventListener('change', () => this.reopen());
    for (const button of document.querySelectorAll('[data-format]')) button.addEventListener('click', () => this.save(button.dataset.format));
    addEventListener('click', (event) => byId('save').contains(event.target) || (byId('save').open = false));
  }

  async open(files) {
    const task = ++this.task;
    const read = await Promise.all(files.map(async (file) => ({ name: file.name, bytes: await file.arrayBuffer() })));
    if (task !== this.task) return;
    this.checker.setFiles(read);
    this.shown = null;
    byId('details').textContent = read[0].name;
    await this.judge();
  }

  async judge() {
    this.checker.limit = byId('limit').value;
    if (this.checker.files.length) await this.show((checker) => checker.check());
  }

  async reopen() {
    this.checker.unit = byId('unit').value;
    this.checker.mesh = null;
    this.shown = null;
    await this.judge();
  }

  /** Shows the result of compute(checker), unless a newer task has begun. */
  async show(compute, then = () => {}) {
    const task = ++this.task, { checker, view } = this;
    try {
      const { page } = await compute(checker), { meshes, generator } = typeof page.data === 'string' ? JSON.parse(page.data) : page.data;
      const models = await modelsOf(meshes, (number) => page.arrays[number]);
      if (task !== this.task) return;
      byId('generator').textContent = generator;
      byId('limit-unit').textContent = checker.mesh.unit ? 'mm' : '';
      byId('save').hidden = false;
      byId('headline').classList.remove('error');
      view.show(models, this.shown === checker.files);
      this.shown = checker.files;
      then();
    } catch (error) {
      if (task === this.task) this.fail(error);
    }
  }

  /** Shows the sentence of a failure. The last result stays if it is of the same files. */
  fail(error) {
    if (error.code === 'cancelled') {
      byId('save').hidden = !this.checker.mesh;
      if (!this.shown) this.clear('Cancelled.');
      return;
    }
    if (!this.shown) finish('empty', '');
    byId('headline').className = 'error';
    byId('headline').textContent = error.message;
    byId('details').textContent = this.checker.name;
    byId('save').hidden = !this.shown;
  }

  clear(text) {
    finish('empty', '');
    byId('headline').className = '';
    byId('headline').textContent = text;
    byId('save').hidden = true;
  }

  async save(format) {
    byId('save').open = false;
    if (format === 'png') return this.view.picture.save();
    try {
      const bytes = await this.checker.run(`Writing ${format}`, () => this.checker.engine.save(format));
      saveFile(new Blob([bytes]), `${this.checker.name.replace(/\.\w+$/, '')}.${format}`);
    } catch (error) {
      this.fail(error);
    }
  }
}

async function start() {
  const view = PageView.create();
  if (!view) throw new Error('This browser has no WebGL 2.');
  const engine = await startEngine();
  new WebPage(view, engine);
  finish('empty', '');
}

start().catch((error) => finish('error', `This browser cannot run the check: ${error.message}`));
