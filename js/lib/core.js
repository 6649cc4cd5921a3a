// The entry `brushfire/core`: meshes from arrays and distances on them, half as large.
import { instantiate } from './load.js';
import { CoreField, CoreLibrary, CoreMesh, Cut } from './mesh.js';

export { BrushfireError } from './errors.js';
export { CoreField as Field, CoreLibrary as Library, CoreMesh as Mesh, Cut };

export const wasmURL = new URL('./core.wasm', import.meta.url);
export const restURL = new URL('./core.rest.wasm', import.meta.url);

export async function load(options = {}) {
  return new CoreLibrary(await instantiate(options.wasm ?? wasmURL, options.rest ?? restURL), CoreMesh);
}
