// How fields are computed, and how a call is watched and stopped.
import { number, text } from './arrays.js';
import { BrushfireError, invalid } from './errors.js';

// Throws for a name that the call does not know: a misspelt option would be ignored otherwise.
export function checkNames(options, names) {
  if (typeof options !== 'object' || options === null) throw invalid('options: an object is needed');
  for (const name of Object.keys(options)) {
    if (!names.includes(name)) throw invalid(`unknown option '${name}': there are ${names.join(', ')}`);
  }
}

export const WATCHED = ['progress', 'signal'];
export const SOLVING = ['method', 'tolerance', 'bound', 'precision', 'maxDistance', ...WATCHED];

const cancelled = () => new BrushfireError('cancelled', 'cancelled');

// What hears how far a call is: `progress` is told, and stops it by returning false; so does `signal` once it is aborted.
// Undefined where there is neither.
export function listenerOf({ progress, signal }) {
  if (signal?.aborted) throw cancelled();
  if (!progress && !signal) return undefined;
  return (share) => progress?.(share) === false || signal?.aborted === true;
}

// As Computation::options() in src/surface.h takes them.
export function solvingArguments(options) {
  const tolerance = options.tolerance === undefined ? NaN : number(options.tolerance, 'tolerance');
  const maxDistance = options.maxDistance === undefined ? NaN : number(options.maxDistance, 'maxDistance');
  // NaN means "not given" behind this line.
  if (options.tolerance !== undefined && Number.isNaN(tolerance)) throw invalid('tolerance nan is not in [0, 0.1]');
  if (options.maxDistance !== undefined && Number.isNaN(maxDistance)) throw invalid('maxDistance: NaN is no distance');
  const watched = options.progress || options.signal ? 1 : 0;
  return [
    text(options.method ?? '', 'method'),
    text(options.bound ?? '', 'bound'),
    text(options.precision ?? '', 'precision'),
    Float64Array.of(tolerance, maxDistance, watched),
  ];
}
