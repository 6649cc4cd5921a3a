// Compiled by types.test.js, not run: what the types let through, and what they refuse.
import { BrushfireError, createPool, load } from 'brushfire';
import type { Curve, DistanceField, Mesh, Method } from 'brushfire';
import { load as loadCore } from 'brushfire/core';

const bf = await load();
const mesh: Mesh = bf.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], new Uint32Array([0, 1, 2]));
const field: DistanceField = mesh.distance([0, { face: 0, weights: [0.5, 0.5, 0], offset: 1 }, { at: [0, 0, 1] }], {
  method: 'windows', tolerance: 1e-3, targets: [1], signal: new AbortController().signal, progress: (share) => share < 0.5 });
const most: number = field.errorBound ? field.errorBound[0] : field.maxErrorBound;
const path: Curve = mesh.path([0, 1], { closed: true });
const floats: Float32Array = mesh.distanceMatrix({ type: 'float32' });
const doubles: Float64Array = mesh.distanceMatrix({ rows: [0], columns: new Uint32Array([1]) });
const kept = mesh.field(0, { keep: 'all' });
kept.isolines({ count: 10, chordError: 1e-3 }).forEach((line) => line.level + line.positions.length);
const torus = bf.shape('torus', 10, 10, 2);
const method: Method = bf.methods[0];

const pool = await createPool({ workers: 2 });
const far = await pool.read(new Uint8Array(), 'a.ply');
const distances: Float64Array = (await far.distance(0, { method })).distance;
const report = (await far.report).remarks;
const cut = await far.cut({ edges: [0, 1] });
const walled: number = cut.mesh.vertexCount;

const core = await loadCore();
core.mesh([], []).distance(0);

try {
  bf.read(new ArrayBuffer(0));
} catch (e) {
  if (e instanceof BrushfireError && e.code === 'file_malformed') console.log(e.message);
}

// @ts-expect-error there is no such method
mesh.distance(0, { method: 'quick' });
// @ts-expect-error there is no such option
mesh.distance(0, { methd: 'exact' });
// @ts-expect-error a torus has two numbers of segments at least
bf.shape('torus', 10);
// @ts-expect-error the core has no paths
core.mesh([], []).path([0, 1]);
// @ts-expect-error windows are kept of two methods only
mesh.field(0, { method: 'dijkstra' });
// @ts-expect-error a promise is no field
(await createPool()).shape('cube', 2).distance(0);

console.log(most, path, floats, doubles, torus, distances, report, walled);
