// In the page that is one file: the worker and the module are in it.
import Worker from 'brushfire/worker?worker&inline';
import wasm from 'virtual:wasm';

export async function poolParts() {
  const bytes = Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return { wasm: await new Response(unpacked).arrayBuffer(), makeWorker: () => new Worker() };
}
