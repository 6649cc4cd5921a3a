// One instance of the WebAssembly: calls that take numbers, texts and typed arrays, and give arrays back.
import { BrushfireError, invalid } from './errors.js';

// In the order of Kind in src/reply.h; the first are texts.
const ARRAYS = [Uint8Array, Float64Array, Float32Array, Uint32Array, Int32Array, Uint8Array];
const TEXT = 0;

const encoder = new TextEncoder();
const decoder = new TextDecoder();

const ENOSYS = 52;

// Numbers of JavaScript are doubles: as few digits as they have, and more until it is the float that they read as.
function digitsOfFloat(value) {
  for (let digits = 0;; ++digits) {
    const text = value.toExponential(digits);
    if (Math.fround(Number(text)) === value) return text;
  }
}

// What a standalone module asks of its surroundings. There are no files: readers are given bytes.
function surroundings(module, memory, state) {
  const wasi = {
    clock_time_get(_clock, _precision, time) {
      new DataView(memory().buffer).setBigUint64(time, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    random_get(at, size) {
      const bytes = new Uint8Array(memory().buffer, at, size);
      for (let i = 0; i < size; i += 65536) crypto.getRandomValues(bytes.subarray(i, i + 65536));
      return 0;
    },
    environ_sizes_get(count, size) {
      const view = new DataView(memory().buffer);
      view.setUint32(count, 0, true);
      view.setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    proc_exit(status) {
      throw new Error(`the module ended with ${status}`);
    },
  };
  // As few digits as it takes to read the number back, at `at` in the memory; how many characters that were.
  const digits = (value, isFloat, at) => encoder.encodeInto(isFloat ? digitsOfFloat(value) : value.toExponential(),
    new Uint8Array(memory().buffer, at)).written;
  const ours = { progress: (share) => state.progress(share), digits };
  const imports = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
    if (kind !== 'function') throw new Error(`the module imports ${from}.${name}, which is no function`);
    imports[from] ??= {};
    // A placeholder's name is the place in the table where the second module puts what is called.
    imports[from][name] = from === 'placeholder' ? (...args) => state.second(Number(name))(...args)
      : (from === 'brushfire' ? ours : wasi)[name] ?? (() => ENOSYS);
  }
  return imports;
}

export class Module {
  #exports;
  #calling = false;
  #broken = null;
  #listener = null; // (share) => whether to stop, of the running call
  #thrown = null; // by the listener
  #second; // () => the module with what is called by placeholders

  static async instantiate(compiled, second) {
    const m = new Module();
    m.#second = second;
    const memory = () => m.#exports.memory;
    const state = { progress: (share) => m.#progress(share), second: (place) => m.#fromSecond(place) };
    const instance = await WebAssembly.instantiate(compiled, surroundings(compiled, memory, state));
    m.#exports = instance.exports;
    m.#exports._initialize?.();
    return m;
  }

  // Bytes that meshes, fields and workspaces take now; and how large the memory has grown, which never shrinks.
  memory() {
    return { used: this.#exports.memory_in_use() >>> 0, grown: this.#exports.memory.buffer.byteLength };
  }

  // Calls an exported function: typed arrays and texts become an address and a size each. What comes back is an array of
  // texts and of typed arrays that JavaScript owns. Throws BrushfireError. `listener` hears the shares done and
  // returns true to stop.
  call(name, args, listener = null) {
    if (this.#broken) throw new BrushfireError('internal', `${this.#broken}; load the package anew`);
    if (this.#calling) throw invalid('called from the progress callback of a running call');
    const given = [];
    this.#calling = true;
    this.#listener = listener;
    this.#thrown = null;
    let reply;
    const stack = this.#exports.emscripten_stack_get_current();
    try {
      const flat = args.flatMap((a) => this.#pass(a, given));
      reply = this.#exports[name](...flat) >>> 0;
    } catch (e) {
      if (e instanceof BrushfireError) {
        this.#exports._emscripten_stack_restore(stack); // it may have passed through functions of the module
        throw e;
      }
      this.#broken = `the module broke down in ${name}: ${e.message}`;
      throw new BrushfireError('internal', this.#broken);
    } finally {
      this.#calling = false;
      this.#listener = null;
      if (!this.#broken) for (const address of given) this.#exports.release(address);
    }
    const { failed, parts } = this.#take(reply);
    if (this.#thrown) throw this.#thrown.error;
    if (failed) throw new BrushfireError(parts[0], parts[1]);
    return parts;
  }

  // Lets go of an object. Nothing to do where the module has broken down.
  free(name, address) {
    if (!this.#broken) this.#exports[name](address);
  }

  has(name) {
    return name in this.#exports;
  }

  #fromSecond(place) {
    const table = this.#exports.__indirect_function_table;
    try {
      new WebAssembly.Instance(this.#second(), { primary: this.#exports });
    } catch (error) {
      throw new BrushfireError('internal', `this call needs the second module, which could not be loaded: ${error.message}; load() and createPool() take it as 'rest'`);
    }
    return table.get(place);
  }

  #progress(share) {
    if (!this.#listener) return 0;
    try {
      return this.#listener(share) ? 1 : 0;
    } catch (error) {
      this.#thrown = { error };
      return 1;
    }
  }

  #pass(argument, given) {
    if (typeof argument === 'number') return [argument];
    if (typeof argument === 'boolean') return [argument ? 1 : 0];
    const array = typeof argument === 'string' ? encoder.encode(argument) : argument;
    if (array.length === 0) return [0, 0];
    const address = this.#exports.allocate(array.byteLength) >>> 0;
    if (address === 0) throw new BrushfireError('too_large', `out of memory: no room for ${array.byteLength} bytes`);
    given.push(address);
    new Uint8Array(this.#exports.memory.buffer, address, array.byteLength).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return [address, array.length];
  }

  #take(reply) {
    const { buffer } = this.#exports.memory;
    const [entries, count, failed] = new Uint32Array(buffer, reply, 3);
    const table = new Uint32Array(buffer, entries, 3 * count);
    const parts = [];
    for (let i = 0; i < count; ++i) {
      const [kind, address, size] = table.subarray(3 * i, 3 * i + 3);
      const array = size === 0 ? new ARRAYS[kind](0) : new ARRAYS[kind](buffer, address, size).slice();
      parts.push(kind === TEXT ? decoder.decode(array) : array);
    }
    this.#exports.reply_free(reply);
    return { failed: failed !== 0, parts };
  }
}
