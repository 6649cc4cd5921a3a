// Compiles and instantiates the WebAssembly, from wherever the caller has it.
import { compile, compileNow, isAhead } from '#platform';
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

// `rest`: the second module, with what an ordinary first picture does not need. Where it has a way to come it sets out once
// the first is there; a call that needs it earlier waits for it.
export async function instantiate(wasm, rest) {
  let arrived = null;
  const module = await Module.instantiate(await compiled(wasm), () => arrived ?? compiledNow(rest));
  if (isAhead) compiled(rest).then((second) => { arrived = second; }, () => {}); // the call that needs it says what is wrong
  return module;
}
