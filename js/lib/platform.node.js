// What differs between Node and browsers: here Node.
import { readFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { parentPort, Worker } from 'node:worker_threads';

export async function compile(url) {
  return WebAssembly.compile(url.protocol === 'file:' ? await readFile(url) : await (await fetch(url)).arrayBuffer());
}

// Whether what is needed later is fetched ahead: files are as near as they can be.
export const isAhead = false;

// While a call waits for it.
export function compileNow(url) {
  if (url.protocol !== 'file:') throw new Error('only files are read while a call waits');
  return new WebAssembly.Module(readFileSync(url));
}

export function processors() {
  return globalThis.navigator?.hardwareConcurrency ?? 2;
}

// {post(message, transfer), end()}; `hear` gets the messages, `fail` what ended the worker.
export function startWorker(make, hear, fail) {
  const worker = make ? make() : new Worker(new URL('./worker.js', import.meta.url));
  worker.on('message', hear);
  worker.on('error', fail);
  // Idle workers do not keep the process alive; running ones do.
  return { post: (message, transfer) => worker.postMessage(message, transfer), end: () => worker.terminate(), hold: (on) => (on ? worker.ref() : worker.unref()) };
}

// The other end, within the worker.
export const port = parentPort && { post: (message, transfer) => parentPort.postMessage(message, transfer), hear: (f) => parentPort.on('message', f) };
