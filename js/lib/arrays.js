// What callers give, as the typed arrays that the module takes. No copy where it is one already.
import { BrushfireError, invalid } from './errors.js';

const described = (x) => (x === null ? 'null' : Array.isArray(x) ? 'an array' : typeof x === 'object' ? x.constructor?.name ?? 'an object' : String(x));

const isTyped = (x) => ArrayBuffer.isView(x) && !(x instanceof DataView);

// Numbers: a typed array, or an array of numbers, or of arrays of numbers.
function flat(x, what) {
  if (isTyped(x)) return x;
  if (typeof x?.[Symbol.iterator] !== 'function' || typeof x === 'string') {
    throw invalid(`${what}: an array of numbers is needed, not ${described(x)}`);
  }
  const numbers = [];
  for (const row of x) {
    if (typeof row === 'number') numbers.push(row);
    else if (Array.isArray(row) || isTyped(row)) for (const n of row) numbers.push(n);
    else throw invalid(`${what}: ${described(row)} is no number`);
  }
  for (const n of numbers) if (typeof n !== 'number') throw invalid(`${what}: ${described(n)} is no number`);
  return numbers;
}

const isBig = (x) => x instanceof BigInt64Array || x instanceof BigUint64Array;

export function doubles(x, what) {
  const numbers = flat(x, what);
  if (numbers instanceof Float64Array) return numbers;
  return isBig(numbers) ? Float64Array.from(numbers, Number) : new Float64Array(numbers);
}

// Vertex numbers of faces.
export function indices(x, what) {
  const numbers = flat(x, what);
  if (numbers instanceof Uint32Array) return numbers;
  if (numbers instanceof Uint16Array || numbers instanceof Uint8Array) return new Uint32Array(numbers);
  const result = new Uint32Array(numbers.length);
  for (let i = 0; i < numbers.length; ++i) {
    const n = Number(numbers[i]);
    if (!Number.isInteger(n) || n < 0 || n > 0xffffffff) {
      throw new BrushfireError('invalid_mesh', `face ${Math.floor(i / 3)} names vertex ${n}, which cannot exist`);
    }
    result[i] = n;
  }
  return result;
}

export function bytes(x, what) {
  if (x instanceof Uint8Array) return x;
  if (ArrayBuffer.isView(x)) return new Uint8Array(x.buffer, x.byteOffset, x.byteLength);
  if (x instanceof ArrayBuffer || (typeof SharedArrayBuffer !== 'undefined' && x instanceof SharedArrayBuffer)) return new Uint8Array(x);
  throw invalid(`${what}: bytes are needed (a Uint8Array or an ArrayBuffer), not ${described(x)}`);
}

export function number(x, what) {
  if (typeof x === 'number') return x;
  throw invalid(`${what}: a number is needed, not ${described(x)}`);
}

export function text(x, what) {
  if (typeof x === 'string') return x;
  throw invalid(`${what}: a text is needed, not ${described(x)}`);
}

export { described, isTyped };
