// What the tests share: the loaded package, meshes of every kind, the native program.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { load } from '../lib/index.js';

export const bf = await load();
export const package_ = fileURLToPath(new URL('..', import.meta.url));
export const project = fileURLToPath(new URL('../..', import.meta.url));

// The command line program, for numbers to compare with; null where it is not built.
const program = process.env.BRUSHFIRE_PROGRAM ?? join(project, 'build/release/brushfire');
export const native = existsSync(program)
  ? (...args) => execFileSync(program, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] })
  : null;
export const withoutNative = native ? false : `${program} is not there: ./run build makes it`;

const folder = mkdtempSync(join(tmpdir(), 'brushfire-js-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
export const inFolder = (name) => join(folder, name);

// A scan where there is one: `./run demo` and the tests of the project fetch it.
export const scan = [join(project, 'demo/bunny.off'), join(project, '../shared/meshes/bunny.off')].find(existsSync);

// Name, how to make it, and a source that is a vertex.
export const meshes = [
  ['plane', () => bf.shape('plane', 20, 14, 2, 1), 5],
  ['saddle', () => bf.shape('saddle', 24, 1.5), 40],
  ['terrain', () => bf.shape('noise-terrain', 40, 30, 0.3), 17],
  ['cube', () => bf.shape('cube', 8), 3],
  ['icosphere', () => bf.shape('icosphere', 4), 0],
  ['poles', () => bf.shape('latlong-sphere', 24, 40), 0],
  ['cone', () => bf.shape('cone', 16, 30, 1, 3), 0],
  ['cylinder', () => bf.shape('cylinder', 12, 20), 9],
  ['torus', () => bf.shape('torus', 60, 30), 0],
  ['folded sphere', () => bf.shape('folded-sphere', 4), 11],
  ['book', () => bf.shape('book', 5, 8, 10), 90],
  ['bow tie', () => bf.shape('bow-tie', 3, 9), 4],
];

export const readNpy = (path) => bf.readField(readFileSync(path), path).values;

// The largest difference of two fields, relative to the larger value; Infinity where one is reached and the other is not.
export function difference(a, b) {
  if (a.length !== b.length) return Infinity;
  let largest = 0;
  for (let v = 0; v < a.length; ++v) {
    if (a[v] === b[v]) continue;
    const d = Math.abs(a[v] - b[v]) / Math.max(Math.abs(a[v]), Math.abs(b[v]));
    largest = Math.max(largest, Number.isNaN(d) ? Infinity : d);
  }
  return largest;
}

export function thrown(call) {
  try {
    call();
  } catch (e) {
    return e;
  }
  return null;
}

// Random numbers that are the same every time.
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
