// Where on a mesh. A place is a vertex number, {vertex}, {face, weights} or {at: [x, y, z]} (the nearest point of the
// surface), with an `offset` where it is a source. Many are an array of them, a typed array of vertex numbers, or
// {faces, weights} as curves and nearest() have them.
import { described, doubles, isTyped } from './arrays.js';
import { BrushfireError, invalid } from './errors.js';

const EMPTY = new Float64Array(0);
const VERTEX = [0, 0, 0];

const isPoints = (x) => typeof x === 'object' && x !== null && 'faces' in x && 'weights' in x;
const isOne = (x) => typeof x === 'number' || (typeof x === 'object' && x !== null && !(Symbol.iterator in x) && ('vertex' in x || 'face' in x || 'at' in x));

function triple(x, what) {
  const numbers = doubles(x, what);
  if (numbers.length === 3) return numbers;
  throw invalid(`${what}: three numbers are needed, not ${numbers.length}`);
}

// {index, weights, offsets}: as src/surface.h takes them. `mesh` finds the nearest points of positions.
export function placeArrays(mesh, places, what) {
  if (isTyped(places)) return { index: doubles(places, what), weights: EMPTY, offsets: EMPTY };
  if (isPoints(places)) {
    return { index: doubles(places.faces, `${what}.faces`), weights: doubles(places.weights, `${what}.weights`), offsets: EMPTY };
  }
  const list = isOne(places) ? [places] : places;
  if (typeof list?.[Symbol.iterator] !== 'function' || typeof list === 'string') {
    throw invalid(`${what}: ${described(places)} is no place: it is a vertex number, {face, weights} or {at: [x, y, z]}`);
  }
  const index = [];
  const weights = [];
  const offsets = [];
  const positions = []; // those of {at}, and which places they are
  let hasWeights = false;
  let hasOffsets = false;
  for (const place of list) {
    if (!isOne(place)) throw invalid(`${what}: ${described(place)} is no place`);
    const p = typeof place === 'number' ? { vertex: place } : place;
    if ('at' in p) positions.push({ k: index.length, at: triple(p.at, `${what}: at`), within: p.within ?? Infinity });
    const inFace = 'face' in p && !('at' in p);
    index.push(Number('vertex' in p ? p.vertex : inFace ? p.face : 0));
    weights.push(...(inFace ? triple(p.weights, `${what}: weights`) : VERTEX));
    offsets.push(p.offset === undefined ? 0 : Number(p.offset));
    hasWeights ||= inFace;
    hasOffsets ||= p.offset !== undefined;
  }
  const result = { index: Float64Array.from(index), weights: Float64Array.from(weights), offsets: hasOffsets ? Float64Array.from(offsets) : EMPTY };
  if (positions.length > 0) snap(mesh, positions, result, what);
  else if (!hasWeights) result.weights = EMPTY;
  // A point without weights would be taken for a vertex.
  for (const [k, place] of hasWeights ? [...list].entries() : []) {
    if (typeof place === 'object' && 'face' in place && !('at' in place) && result.weights.subarray(3 * k, 3 * k + 3).every((w) => w === 0)) {
      throw invalid(`${what}: weights of a point of face ${place.face} sum to 0, not to 1`);
    }
  }
  return result;
}

const isCurve = (x) => typeof x === 'object' && x !== null && 'curve' in x;

// The same for sources, of which some may be curves: {curve, closed, offset}, whose `curve` is places. {..., sizes}: as
// SourceKinds of src/surface.h has them.
export function sourceArrays(mesh, sources) {
  const list = isCurve(sources) ? [sources] : sources;
  if (typeof list?.[Symbol.iterator] !== 'function' || isTyped(list) || ![...list].some(isCurve)) {
    return { ...placeArrays(mesh, sources, 'sources'), sizes: EMPTY };
  }
  const parts = [...list].map((source) => {
    if (!isCurve(source)) return { ...placeArrays(mesh, [source], 'sources'), size: 0, offset: Number(source.offset ?? 0) };
    const places = placeArrays(mesh, source.curve, 'sources: curve');
    if (places.offsets.length > 0) throw invalid('sources: a curve has one offset, beside its places');
    const closed = source.closed ?? source.curve.closed ?? false;
    return { ...places, size: closed ? -places.index.length : places.index.length, offset: Number(source.offset ?? 0) };
  });
  const empty = parts.findIndex(({ index }) => index.length === 0);
  if (empty >= 0) throw invalid(`sources: the curve at position ${empty} has no places`);
  const weights = parts.flatMap((part) => [...(part.weights.length > 0 ? part.weights : new Float64Array(3 * part.index.length))]);
  return {
    index: Float64Array.from(parts.flatMap(({ index }) => [...index])),
    weights: Float64Array.from(weights),
    offsets: Float64Array.from(parts, ({ offset }) => offset),
    sizes: Float64Array.from(parts, ({ size }) => size),
  };
}

function snap(mesh, positions, result, what) {
  const found = mesh.nearest(positions.flatMap(({ at }) => [...at]));
  positions.forEach(({ k, at, within }, i) => {
    if (found.distances[i] > within) {
      throw new BrushfireError('invalid_argument', `${what}: (${[...at].join(', ')}) is ${found.distances[i]} from the surface, more than ${within}`);
    }
    result.index[k] = found.faces[i];
    result.weights.set(found.weights.subarray(3 * i, 3 * i + 3), 3 * k);
  });
}
