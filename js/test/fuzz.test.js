// Whatever arrays and bytes come: a result, or a BrushfireError that is not `internal`. The module never breaks down.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { BrushfireError } from '../lib/index.js';
import { bf, random } from './support.js';

const ROUNDS = 3000;

function attempt(what, call) {
  try {
    return call();
  } catch (e) {
    assert.ok(e instanceof BrushfireError && e.code !== 'internal', `${what()}: ${e.stack}`);
    return null;
  }
}

const SPECIAL = [0, -0, -1, 1, 1e-320, 1e308, -1e308, NaN, Infinity, -Infinity, 0.5, 2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 53];

test('random meshes, sources and options', () => {
  const seed = 20260101;
  const r = random(seed);
  const some = (n) => Math.floor(r() * n);
  const odd = () => (r() < 0.5 ? SPECIAL[some(SPECIAL.length)] : (r() - 0.5) * 10 ** some(20));
  for (let round = 0; round < ROUNDS; ++round) {
    let vertices, faces, sources = [];
    const what = () => JSON.stringify({ seed, round, vertices: vertices && [...vertices], faces, sources });
    const n = some(9);
    const tame = r() < 0.8;
    vertices = Float64Array.from({ length: 3 * n + (r() < 0.03 ? 1 : 0) }, () => (tame ? some(4) + r() * some(2) : Math.min(1e15, Math.max(-1e15, odd()))));
    faces = Array.from({ length: 3 * some(12) }, () => (r() < 0.97 ? some(n) : odd()));
    const mesh = attempt(what, () => bf.mesh(vertices, faces));
    if (!mesh) continue;
    const place = () => [some(n), { vertex: some(n) }, { face: some(mesh.faceCount), weights: [r(), 0, 0].map((w, k, a) => (k === 1 ? 1 - a[0] : w)) },
      { at: [r(), r(), r()] }, odd(), { face: odd(), weights: [odd(), odd(), odd()] }, { at: [odd(), odd(), odd()] }][some(r() < 0.8 ? 4 : 7)];
    const options = () => ({
      method: bf.methods[some(bf.methods.length)],
      ...(r() < 0.3 && { tolerance: r() < 0.5 ? r() / 10 : odd() }),
      ...(r() < 0.2 && { maxDistance: odd() }),
      ...(r() < 0.2 && { bound: ['upper', 'lower', 'estimate', 'x'][some(4)] }),
      ...(r() < 0.2 && { precision: ['float32', 'float64'][some(2)] }),
    });
    sources = Array.from({ length: some(4) }, place);
    const field = attempt(what, () => mesh.distance(sources, options()));
    if (field) for (const d of field.distance) assert.ok(!Number.isNaN(d) && d !== -Infinity, what());
    const values = field?.distance ?? Float64Array.from({ length: some(9) }, odd);
    attempt(what, () => mesh.report);
    attempt(what, () => mesh.isolines(values, { count: some(5) }));
    attempt(what, () => mesh.path([place(), place()], { closed: r() < 0.2, tighten: r() < 0.5 }));
    attempt(what, () => mesh.logMap(place()));
    attempt(what, () => mesh.voronoi(sources, options()));
    attempt(what, () => mesh.trace(place(), odd(), Math.min(odd(), 50))); // a walk takes as long as it is
    attempt(what, () => mesh.distanceMatrix({ ...options(), rows: sources }));
    attempt(what, () => mesh.certify(values, sources));
    attempt(what, () => mesh.farthestPoints(some(5), options()));
    const kept = attempt(what, () => mesh.field(sources, { method: 'exact' }));
    if (kept) {
      attempt(what, () => kept.paths(Array.from({ length: 3 }, place)));
      attempt(what, () => kept.isolines({ count: 3, chordError: 0.01 }));
      kept.free();
    }
    const cut = attempt(what, () => mesh.cut({ faces: [some(mesh.faceCount + 1)], edges: [some(n), some(n)] }));
    cut?.free();
    mesh.free();
  }
});

test('files that were damaged', () => {
  const seed = 7;
  const r = random(seed);
  const mesh = bf.shape('torus', 6, 4);
  const formats = bf.formats.meshesWritten.map(({ extensions }) => extensions[0]);
  for (const format of formats) {
    const whole = mesh.write(format);
    for (let round = 0; round < 200; ++round) {
      const bytes = whole.slice(0, r() < 0.3 ? Math.floor(r() * whole.length) : whole.length);
      for (let k = Math.floor(r() * 6); k > 0; --k) bytes[Math.floor(r() * Math.min(bytes.length, 400))] = Math.floor(r() * 256);
      attempt(() => `${format}, round ${round}`, () => bf.read(bytes, `file.${format}`))?.free();
    }
  }
  mesh.free();
});
