// In the page that is one file: the worker and the module are in it.
import Worker from 'brushfire/worker?worker&inline';
import wasm from 'virtual:wasm';
import rest from 'virtual:rest';

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

export async function poolParts() {
  return { wasm: await unpacked(wasm), rest: await unpacked(rest), makeWorker: () => new Worker() };
}
