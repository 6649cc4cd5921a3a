// What differs between Node and browsers: here browsers, and what runs like them.

export async function compile(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  // Servers that do not know the type of .wasm files are not streamed from.
  if (/^application\/wasm\b/.test(response.headers.get('content-type') ?? '')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

// Whether what is needed later is fetched ahead.
export const isAhead = true;

// While a call waits for it: pages, other than workers, are given texts only.
export function compileNow(url) {
  const request = new XMLHttpRequest();
  request.open('GET', url, false);
  request.overrideMimeType('text/plain; charset=x-user-defined');
  request.send();
  if (request.status !== 200) throw new Error(`${url}: ${request.status} ${request.statusText}`);
  return new WebAssembly.Module(Uint8Array.from(request.responseText, (c) => c.charCodeAt(0)));
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
