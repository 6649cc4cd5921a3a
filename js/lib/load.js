// Compiles and instantiates the WebAssembly, from wherever the caller has it.
import { compile } from '#platform';
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

export const instantiate = async (wasm) => Module.instantiate(await compiled(wasm));
