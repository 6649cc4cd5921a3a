// The same calls in workers.
import assert from 'node:assert/strict';
import { test, after } from 'node:test';

import { BrushfireError, createPool } from '../lib/index.js';
import { bf, difference } from './support.js';

const pool = await createPool({ workers: 2 });
after(() => pool.close());

async function rejected(promise) {
  try {
    await promise;
  } catch (e) {
    return e;
  }
  return null;
}

test('results are those of the synchronous calls', async () => {
  const mesh = bf.shape('folded-sphere', 4);
  const other = await pool.mesh(mesh.vertices, mesh.faces);
  assert.equal(other.vertexCount, mesh.vertexCount);
  assert.deepEqual(await other.faces, mesh.faces);
  assert.deepEqual(await other.report, mesh.report);
  const all = await Promise.all(bf.methods.map((method) => other.distance(3, { method })));
  bf.methods.forEach((method, k) => assert.equal(difference(all[k].distance, mesh.distance(3, { method }).distance), 0));
  const field = await other.field(3);
  assert.equal((await field.path(100)).length, mesh.path([3, 100]).length);
  assert.deepEqual((await field.at([5])).distance[0], field.distance[5]);
  // Levels that follow from the field's values, of which the caller has got a copy.
  const arcs = await field.isolines({ count: 4, chordError: 0.01 });
  const here = mesh.field(3);
  assert.ok(arcs.length >= 4);
  assert.deepEqual(arcs.map((a) => a.length), here.isolines({ count: 4, chordError: 0.01 }).map((a) => a.length));
  here.free();
  const lines = await other.isolines(all[0].distance, { count: 4 });
  assert.deepEqual(lines, mesh.isolines(all[0].distance, { count: 4 }));
  const cut = await other.cut({ faces: [0, 1] });
  assert.equal(cut.mesh.faceCount, mesh.faceCount - 2);
  const { distance } = await cut.mesh.distance(50);
  assert.equal((await cut.toOriginal(distance)).distance.length, mesh.vertexCount);
  assert.equal((await other.weld(0)).mesh.vertexCount, mesh.vertexCount);
  assert.equal((await other.subdivide()).faceCount, 4 * mesh.faceCount);
  const read = await pool.read(mesh.write('ply'), 'mesh.ply');
  assert.equal(read.file.format, 'PLY');
  const { absolute } = await pool.compare(all[0].distance, all[2].distance);
  assert.ok(absolute.max > 0);
  for (const m of [mesh, other, cut, read, field]) m.free();
});

test('errors come over with their codes', async () => {
  const mesh = await pool.shape('cube', 3);
  const error = await rejected(mesh.distance(1000));
  assert.ok(error instanceof BrushfireError);
  assert.equal(error.code, 'index_out_of_range');
  assert.equal((await rejected(pool.read(new Uint8Array([1, 2, 3]), 'a.ply'))).code, 'file_malformed');
  assert.equal((await rejected(pool.mesh([() => 1], [0, 1, 2]))).code, 'invalid_argument');
  mesh.free();
  assert.match((await rejected(mesh.distance(0))).message, /freed/);
});

test('progress is told, and two calls run at a time', async () => {
  const mesh = await pool.shape('folded-sphere', 6);
  const shares = [];
  await Promise.all([mesh.distance(0, { method: 'exact', progress: (share) => { shares.push(share); } }), mesh.distance(1, { method: 'exact' })]);
  assert.ok(shares.length > 0 && shares.every((s) => s >= 0 && s <= 1));
  mesh.free();
});

for (const [name, call] of [
  ['a call that listens', (mesh, signal) => mesh.distance(0, { method: 'exact', signal })],
  ['a call that waits for its turn', (mesh, signal) => {
    for (let k = 0; k < 6; ++k) mesh.distance(k);
    return mesh.distance(0, { signal });
  }],
]) {
  test(`${name} is stopped at once, and everything goes on afterwards`, async () => {
    const mesh = await pool.shape('folded-sphere', 7);
    const controller = new AbortController();
    const begin = performance.now();
    const result = rejected(call(mesh, controller.signal));
    setTimeout(() => controller.abort(), 150);
    assert.equal((await result).code, 'cancelled');
    assert.ok(performance.now() - begin < 2000);
    assert.equal((await mesh.distance(0, { method: 'dijkstra' })).reached, mesh.vertexCount);
    mesh.free();
  });
}

test('without shared memory a cancelled worker is replaced, and makes its meshes anew', async () => {
  const shared = globalThis.SharedArrayBuffer;
  const mesh = await pool.shape('folded-sphere', 6);
  const { distance } = await mesh.distance(0, { method: 'dijkstra' });
  globalThis.SharedArrayBuffer = undefined;
  try {
    const controller = new AbortController();
    const result = rejected(mesh.distance(0, { method: 'exact', signal: controller.signal }));
    setTimeout(() => controller.abort(), 50);
    assert.equal((await result).code, 'cancelled');
  } finally {
    globalThis.SharedArrayBuffer = shared;
  }
  const again = await Promise.all([0, 0, 0].map(() => mesh.distance(0, { method: 'dijkstra' })));
  for (const field of again) assert.deepEqual(field.distance, distance);
  mesh.free();
});

test('a progress callback that returns false stops the call', async () => {
  const mesh = await pool.shape('folded-sphere', 7);
  assert.equal((await rejected(mesh.distance(0, { method: 'exact', progress: () => false }))).code, 'cancelled');
  mesh.free();
});

test('a closed pool says so', async () => {
  const own = await createPool({ workers: 1 });
  const mesh = await own.shape('cube', 2);
  const running = rejected(mesh.distance(0));
  own.close();
  assert.equal((await running).code, 'cancelled');
  assert.equal((await rejected(mesh.distance(0))).code, 'invalid_argument');
});
