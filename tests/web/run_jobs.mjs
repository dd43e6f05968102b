// Runs jobs with the engine:  node run_jobs.mjs BUILD_FOLDER < jobs.json
// jobs.json: a list of { files, unit, check, compute, save }. files: paths, the mesh first. check, compute: options; a call
// without options is left out. save: paths of results. Prints one line of JSON per job: { mesh, seconds } or
// { error, code }.

import { readFile, writeFile } from 'node:fs/promises';
import { basename, extname } from 'node:path';
import { text } from 'node:stream/consumers';

import { startNodeEngine } from './node_engine.mjs';

async function runJob(engine, { files, unit, check, compute, save = [] }) {
  const seconds = {};
  const timed = async (name, work) => {
    const begin = performance.now();
    const result = await work();
    seconds[name] = (performance.now() - begin) / 1000;
    return result;
  };
  const read = await Promise.all(files.map(async (path) => ({ name: basename(path), bytes: await readFile(path) })));
  const mesh = await timed('open', () => engine.open(read, { unit }));
  if (check) await timed('check', () => engine.check(check));
  if (compute) await timed('compute', () => engine.compute(compute));
  for (const path of save) await writeFile(path, await engine.save(extname(path).slice(1)));
  return { mesh, seconds };
}

const engine = await startNodeEngine(process.argv[2]);
for (const job of JSON.parse(await text(process.stdin))) {
  const result = await runJob(engine, job).catch(({ code, message }) => ({ error: message, code }));
  console.log(JSON.stringify(result));
}
process.exit(0);
