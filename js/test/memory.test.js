// What is taken is given back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from '../lib/index.js';
import { bf, thrown } from './support.js';

test('10000 solves take no more memory than the first hundred', () => {
  const mesh = bf.shape('torus', 30, 15);
  const solve = (k) => {
    const options = { method: bf.methods[k % bf.methods.length] };
    mesh.distance(k % mesh.vertexCount, options);
    if (k % 50 === 0) mesh.field(k % mesh.vertexCount).free();
    if (k % 70 === 0) mesh.isolines(mesh.distance(0).distance, { count: 5 });
    if (k % 90 === 0) thrown(() => mesh.distance(mesh.vertexCount));
    if (k % 110 === 0) thrown(() => mesh.distance(0, { progress: () => false }));
  };
  for (let k = 0; k < 200; ++k) solve(k);
  const before = bf.memory();
  for (let k = 0; k < 10000; ++k) solve(k);
  const after = bf.memory();
  assert.equal(after.grown, before.grown);
  assert.ok(Math.abs(after.used - before.used) < 64 * 1024, `${before.used} bytes before, ${after.used} after`);
  mesh.free();
});

test('meshes that are freed leave nothing behind', () => {
  const round = () => {
    const mesh = bf.shape('icosphere', 4);
    mesh.distance(0);
    mesh.nearest([2, 0, 0]);
    const cut = mesh.cut({ faces: [0, 1, 2] });
    cut.mesh.distance(100);
    cut.free();
    mesh.free();
  };
  round();
  const before = bf.memory().used;
  for (let k = 0; k < 50; ++k) round();
  assert.ok(bf.memory().used <= before + 1024, `${before} bytes before, ${bf.memory().used} after`);
});

test('meshes that nobody has are freed by the collector', async (t) => {
  if (!globalThis.gc) {
    t.skip('run with --expose-gc');
    return;
  }
  const own = await load();
  const wait = () => new Promise((resolve) => setTimeout(resolve, 20));
  const before = own.memory().used;
  for (let k = 0; k < 20; ++k) own.shape('icosphere', 4);
  assert.ok(own.memory().used > before + 1e6);
  for (let k = 0; k < 50 && own.memory().used > before + 1e5; ++k) {
    globalThis.gc();
    await wait();
  }
  assert.ok(own.memory().used <= before + 1e5, `${own.memory().used - before} bytes are left`);
});

test('a freed mesh says so, and freeing it again is nothing', () => {
  const mesh = bf.shape('cube', 2);
  mesh.free();
  mesh.free();
  const error = thrown(() => mesh.distance(0));
  assert.equal(error.code, 'invalid_argument');
  assert.match(error.message, /freed/);
});

test('a field outlives its mesh', () => {
  const mesh = bf.shape('cube', 4);
  const field = mesh.field(0);
  const [before] = field.at(50).distance;
  mesh.free();
  bf.shape('cube', 6).free();
  assert.equal(field.module.call('field_values', [field.address, Float64Array.of(50), new Float64Array(0)])[0][0], before);
  field.free();
});
