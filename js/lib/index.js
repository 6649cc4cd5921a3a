// The package's main entry: everything.
import { Field, Library, Mesh } from './full.js';
import { instantiate } from './load.js';
import { Cut } from './mesh.js';
import { Pool } from './pool.js';

export { BrushfireError } from './errors.js';
export { Cut, Field, Library, Mesh, Pool };

export const wasmURL = new URL('./brushfire.wasm', import.meta.url);
export const restURL = new URL('./brushfire.rest.wasm', import.meta.url);

export async function load(options = {}) {
  return new Library(await instantiate(options.wasm ?? wasmURL, options.rest ?? restURL));
}

export async function createPool(options = {}) {
  return Pool.start(options, wasmURL, restURL);
}
