// Times of the package beside those of the native program, on one thread: medians of interleaved runs.
//   node js/speed.mjs MESH...   (after ./run web; BRUSHFIRE_PROGRAM is the program, else build/release/brushfire)
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';

import { load } from './lib/index.js';

const program = process.env.BRUSHFIRE_PROGRAM ?? fileURLToPath(new URL('../build/release/brushfire', import.meta.url));
const RUNS = 7;
const median = (a) => a.sort((x, y) => x - y)[a.length >> 1];

// What the program says of itself: set-up and solving, without the reading of files.
function native(file, method, tolerance) {
  const args = ['distance', file, '--source', '0', '--method', method, '--threads', '1', '--json'];
  if (method === 'windows') args.push('--tolerance', String(tolerance));
  const { set_up_s: setUp, solve_s: solve } = JSON.parse(execFileSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 30 }));
  return { setUp, solve };
}

const bf = await load();
console.log('mesh                 vertices  method         solve: native   here  ratio   set-up: native   here');
for (const file of process.argv.slice(2)) {
  const mesh = bf.read(readFileSync(file), file);
  for (const [method, tolerance] of [['windows', 1e-2], ['windows', 1e-3], ['exact', 0], ['novotni-klein', 0]]) {
    const options = { method, ...(method === 'windows' && { tolerance }) };
    const times = { native: [], here: [], nativeSetUp: [], hereSetUp: [] };
    for (let k = 0; k < RUNS; ++k) {
      const there = native(file, method, tolerance);
      const fresh = bf.mesh(mesh.vertices, mesh.faces);
      const begin = performance.now();
      fresh.setUp(options);
      const ready = performance.now();
      fresh.distance(0, options);
      const first = performance.now();
      fresh.distance(0, options);
      const end = performance.now();
      fresh.free();
      times.native.push(there.solve * 1e3);
      times.nativeSetUp.push(there.setUp * 1e3);
      times.here.push(Math.min(first - ready, end - first));
      times.hereSetUp.push(ready - begin);
    }
    const [a, b, c, d] = [times.native, times.here, times.nativeSetUp, times.hereSetUp].map(median);
    const name = method === 'windows' ? `windows ${tolerance}` : method;
    console.log(`${basename(file).padEnd(20)} ${String(mesh.vertexCount).padStart(8)}  ${name.padEnd(14)} ${a.toFixed(1).padStart(10)} ms ${b.toFixed(1).padStart(6)} ${(b / a).toFixed(2).padStart(6)} ${c.toFixed(1).padStart(14)} ms ${d.toFixed(1).padStart(6)}`);
  }
  mesh.free();
}
