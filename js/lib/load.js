// Compiles and instantiates the WebAssembly, from wherever the caller has it.
import { compile, compileNow } from '#platform';
import { invalid } from './errors.js';
import { Module } from './module.js';

// `wasm`: a compiled module, its bytes, or where it is to be had.
export async function compiled(wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return WebAssembly.compile(wasm);
  if (typeof wasm === 'string') return compile(new URL(wasm, globalThis.location?.href ?? import.meta.url));
  if (wasm instanceof URL) return compile(wasm);
  throw invalid('wasm: a WebAssembly.Module, bytes or a URL is needed');
}

// The same, while a call waits for it.
function compiledNow(wasm) {
  if (wasm instanceof WebAssembly.Module) return wasm;
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return new WebAssembly.Module(wasm);
  return compileNow(new URL(wasm, globalThis.location?.href ?? import.meta.url));
}

// `wide`: the second module, with what few meshes need; nothing is fetched before one does.
export const instantiate = async (wasm, wide) => Module.instantiate(await compiled(wasm), () => compiledNow(wide));
