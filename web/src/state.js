// What the page shows, as plain data: kept for undo, and in the address for shapes that are built in.

export const SHAPES = {
  'folded sphere': ['folded-sphere', 5],
  torus: ['torus', 120, 60],
  sphere: ['icosphere', 5],
  terrain: ['noise-terrain', 120, 120, 0.25],
  cube: ['cube', 40],
  cylinder: ['cylinder', 40, 80],
  saddle: ['saddle', 80, 1],
  cone: ['cone', 60, 120, 1, 2],
};

// What can be on or off, and is in the address where it is on.
const SWITCHES = ['beside', 'arcs', 'cells'];

// What colours tell: how far, on which side of a curve and how far, and coordinates around a source as a pattern.
export const VIEWS = ['distance', 'sides', 'log map'];

export const initial = () => ({ shape: 'folded sphere', sources: [{ face: 0, weights: [1, 0, 0] }], method: 'windows', tolerance: '1e-3', against: '', beside: false, by: 'distance', walls: [], colormap: 'viridis', lines: 20, every: '', arcs: false, cells: false });

export const digits = (w) => String(Number(w.toFixed(12)));

// Weights as they come back from their text: a shared page shows the same numbers.
export const tidy = (source) => (isCurve(source) ? { ...source, through: source.through.map(tidyPlace) } : tidyPlace(source));
const tidyPlace = ({ face, weights }) => {
  const [a, b] = weights.slice(0, 2).map((w) => Number(digits(w)));
  return { face, weights: [a, b, Math.max(0, Number(digits(1 - a - b)))] };
};

export const placeText = ({ face, weights }) => `f:${face}:${weights.map(digits).join(',')}`;

// A source is a place, or a curve: {through: places, closed}, which is shortest between them. As text in the address.
export const isCurve = (source) => 'through' in source;
const sourceText = (s) => (isCurve(s) ? `${s.closed ? 'loop' : 'curve'}:${s.through.map(placeText).join(';')}` : placeText(s));

function placeOf(text) {
  const [, face, weights] = /^f:(\d+):([-\d.e,]+)$/.exec(text) ?? [];
  const place = { face: Number(face), weights: weights?.split(',').map(Number) ?? [] };
  return Number.isInteger(place.face) && place.weights.length === 3 && place.weights.every(Number.isFinite) ? place : null;
}

// A wall is {through: places}, along the edges nearest to them.
const wallText = ({ through }) => through.map(placeText).join(';');

function placesOf(text) {
  const through = text.split(';').map(placeOf);
  return through.length > 1 && through.every(Boolean) ? through : null;
}

// Null where the text is none.
function sourceOf(text) {
  const [, kind, list] = /^(curve|loop):(.*)$/.exec(text) ?? [];
  if (!kind) return placeOf(text);
  const through = placesOf(list);
  return through && { through, closed: kind === 'loop' };
}

// The places that can be taken hold of: of which source, and which of its places.
export const handles = (sources) => sources.flatMap((s, k) => (isCurve(s) ? s.through.map((place, j) => ({ place, k, j })) : [{ place: s, k, j: 0 }]));

// The sources with one of these places somewhere else.
export const withHandle = (sources, { k, j }, place) => sources.map((s, i) => {
  if (i !== k) return s;
  return isCurve(s) ? { ...s, through: s.through.map((p, l) => (l === j ? place : p)) } : place;
});

export function toFragment(state) {
  const words = new URLSearchParams({ shape: state.shape, method: state.method, tolerance: state.tolerance, against: state.against, by: state.by, colours: state.colormap, lines: String(state.lines) });
  if (state.every) words.set('every', state.every);
  for (const name of SWITCHES) if (state[name]) words.set(name, '1');
  for (const source of state.sources) words.append('source', sourceText(source));
  for (const wall of state.walls) words.append('wall', wallText(wall));
  return `#${words}`;
}

// Null where the fragment does not say anything usable.
export function fromFragment(fragment) {
  const words = new URLSearchParams(fragment.replace(/^#/, ''));
  if (!(words.get('shape') in SHAPES)) return null;
  const sources = words.getAll('source').map(sourceOf);
  const walls = words.getAll('wall').map(placesOf);
  const start = initial();
  if (sources.length === 0 || !sources.every(Boolean) || !walls.every(Boolean)) return null;
  return { ...start, shape: words.get('shape'), sources, method: words.get('method') ?? start.method, tolerance: words.get('tolerance') ?? start.tolerance, against: words.get('against') ?? start.against, by: VIEWS.includes(words.get('by')) ? words.get('by') : start.by, walls: walls.map((through) => ({ through })),
    colormap: words.get('colours') ?? start.colormap, lines: Math.min(60, Math.max(0, Number(words.get('lines') ?? start.lines) || 0)),
    every: Number(words.get('every')) > 0 ? words.get('every') : '', ...Object.fromEntries(SWITCHES.map((name) => [name, words.get(name) === '1'])) };
}

// One step back, one step forth.
export class History {
  #past = [];
  #future = [];

  add(state) {
    this.#past.push(structuredClone(state));
    this.#future = [];
  }

  undo(now) {
    return this.#move(this.#past, this.#future, now);
  }

  redo(now) {
    return this.#move(this.#future, this.#past, now);
  }

  clear() {
    this.#past = [];
    this.#future = [];
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  #move(from, to, now) {
    const state = from.pop();
    if (state) to.push(structuredClone(now));
    return state;
  }
}

// How the field is computed, and the one that it is compared with, if any.
export const solving = ({ method, tolerance }) => (method === 'windows' ? { method, tolerance: Number(tolerance) } : { method });
export const computationsOf = (state) => [solving(state), ...(state.against ? [{ method: state.against }] : [])];
