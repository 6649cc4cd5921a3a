// What differs between Node and browsers: here browsers, and what runs like them.

export async function compile(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  // Servers that do not know the type of .wasm files are not streamed from.
  if (/^application\/wasm\b/.test(response.headers.get('content-type') ?? '')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

export function processors() {
  return globalThis.navigator?.hardwareConcurrency ?? 2;
}

export function startWorker(make, hear, fail) {
  const worker = make ? make() : new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  worker.onmessage = ({ data }) => hear(data);
  worker.onerror = (event) => fail(event.error ?? new Error(event.message ?? 'the worker could not be started'));
  return { post: (message, transfer) => worker.postMessage(message, transfer), end: () => worker.terminate(), hold: () => {} };
}

export const port = typeof self !== 'undefined' && typeof self.postMessage === 'function' && {
  post: (message, transfer) => self.postMessage(message, transfer),
  hear: (f) => self.addEventListener('message', ({ data }) => f(data)),
};
