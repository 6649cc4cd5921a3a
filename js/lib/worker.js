// A worker of the pool: makes objects from their recipes when they are first needed, and calls their methods.
import { port } from '#platform';
import { BrushfireError } from './errors.js';
import { load } from './index.js';

let library;
const objects = new Map(); // number -> object

// The buffers of a result, which are moved and not copied: nobody here needs them any more. (Those of an object are its own,
// and are copied: what is asked of a field later needs its distances.)
function buffersIn(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (Array.isArray(value)) for (const entry of value) buffersIn(entry, found);
  else if (typeof value === 'object' && value !== null) for (const entry of Object.values(value)) buffersIn(entry, found);
  return found;
}

// What the caller sees of an object: its own data; of objects in it the same, under `parts`.
function dataOf(object) {
  const data = { parts: {} };
  for (const [name, value] of Object.entries(object)) {
    if (typeof value?.free === 'function') data.parts[name] = dataOf(value);
    else data[name] = value;
  }
  return data;
}

// A recipe: {id, of (the number of another object, 0: the library), method, args}, or {id, of, part (of that object)}.
function make({ id, of, method, args, part }, watch) {
  const from = of === 0 ? library : objects.get(of);
  const made = part ? from[part] : from[method](...withWatch(args, watch));
  objects.set(id, made);
  return made;
}

function withWatch(args, watch) {
  return args.map((a) => (a?.watched === true ? { ...a.options, ...watch } : a));
}

function watchOf({ id, flag, wantsProgress }) {
  const watch = {};
  let last = 0;
  if (flag) watch.signal = { get aborted() { return Atomics.load(flag, 0) !== 0; } };
  if (wantsProgress) {
    watch.progress = (share) => {
      const now = performance.now();
      if (now - last < 30) return;
      last = now;
      port.post({ id, progress: share });
    };
  }
  return watch;
}

function answer(message) {
  const watch = watchOf(message);
  for (const recipe of message.recipes) make(recipe, {});
  if (message.make) {
    const result = make(message.make, watch);
    return dataOf(result);
  }
  const from = message.of === 0 ? library : objects.get(message.of);
  const member = from[message.method];
  return typeof member === 'function' ? member.apply(from, withWatch(message.args, watch)) : member;
}

port.hear(async (message) => {
  if (message.start) {
    try {
      library = await load({ wasm: message.start, rest: message.rest });
      port.post({ started: true });
    } catch (e) {
      port.post({ started: false, error: { code: 'internal', message: e.message } });
    }
    return;
  }
  if (message.free) {
    objects.get(message.free)?.free?.();
    objects.delete(message.free);
    return;
  }
  try {
    const result = answer(message);
    port.post({ id: message.id, result }, message.make ? [] : [...buffersIn(result)]);
  } catch (e) {
    const code = e instanceof BrushfireError ? e.code : 'internal';
    port.post({ id: message.id, error: { code, message: e.message } });
  }
});
