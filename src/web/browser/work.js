// The progress of a call of the engine, with a button that cancels it. It appears only for long calls.
import { byId } from './elements.js';

const kQuietMilliseconds = 200;

/** Runs call(onProgress) and shows its progress. onShown() is called when the progress appears. */
export async function showWork(name, call, onShown) {
  const bar = byId('work-share'), timer = setTimeout(() => {
    byId('work').hidden = false;
    onShown();
  }, kQuietMilliseconds);
  byId('work-name').textContent = name;
  bar.removeAttribute('value');
  try {
    return await call((share) => bar.value = share);
  } finally {
    clearTimeout(timer);
    byId('work').hidden = true;
  }
}
