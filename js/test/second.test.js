// The second module, with what a first picture does not need; and numbers as text, by the digits of the engine.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { test } from 'node:test';

import { load as loadCore, restURL as coreRestURL } from '../lib/core.js';
import { load, restURL } from '../lib/index.js';
import { bf, difference, inFolder, meshes, native, random, readNpy, withoutNative } from './support.js';

// A hub so far above its rim that doubles do not do.
function needles(of) {
  const vertices = [0, 0, 1e9];
  const faces = [];
  for (let k = 0; k < 12; ++k) {
    vertices.push(Math.cos((k * Math.PI) / 6), Math.sin((k * Math.PI) / 6), 0);
    faces.push(0, 1 + k, 1 + ((k + 1) % 12));
  }
  return of.mesh(vertices, faces);
}
const nothing = new Uint8Array(3); // in place of a module

test('wide numbers are the native ones, however their module is given', { skip: withoutNative }, async () => {
  const mesh = needles(bf);
  writeFileSync(inFolder('needles.ply'), mesh.write('ply'));
  const bytes = readFileSync(restURL);
  const libraries = [bf, await load({ rest: bytes }), await load({ rest: new WebAssembly.Module(bytes) }), await load({ rest: restURL.href }),
    await loadCore(), await loadCore({ rest: coreRestURL })];
  for (const method of ['windows', 'exact']) {
    native('distance', inFolder('needles.ply'), '--source', '1', '--method', method, '-o', inFolder('needles.npy'));
    const expected = readNpy(inFolder('needles.npy'));
    for (const library of libraries) assert.ok(difference(needles(library).distance(1, { method }).distance, expected) <= 1e-15);
  }
  mesh.free();
});

test('where their module is not to be had, calls that need it say so, and others go on', async () => {
  const without = await load({ rest: nothing });
  const hub = needles(without);
  const before = without.memory().used;
  for (let k = 0; k < 1000; ++k) {
    assert.throws(() => hub.distance(1, { method: 'exact' }), { code: 'internal', message: /second module.*load\(\) and createPool\(\) take it as 'rest'/ });
  }
  const other = without.shape('torus', 24, 12);
  const mine = bf.shape('torus', 24, 12);
  assert.equal(difference(other.distance(0).distance, mine.distance(0).distance), 0);
  other.free();
  mine.free();
  assert.ok(without.memory().used < before + 1e5, `${without.memory().used - before} bytes are lost`);
});

test('a first picture does not need it', async () => {
  for (const library of [await load({ rest: nothing }), await loadCore({ rest: nothing })]) {
    for (const [name, make, source] of meshes) {
      const made = make();
      const mesh = library.mesh(made.vertices, made.faces);
      const inFace = { face: 2, weights: [0.2, 0.3, 0.5] };
      for (const method of ['windows', 'exact', 'novotni-klein']) {
        for (const from of [source, [inFace]]) assert.ok(mesh.distance(from, { method }).reached > 0, `${name}, ${method}`);
        assert.ok(mesh.distance(source, { method, maxDistance: 0.5 }).reached > 0, `${name}, ${method}`);
      }
      assert.throws(() => mesh.distance(source, { maxDistance: -1 }), { code: 'invalid_argument' });
      assert.throws(() => library.mesh(made.vertices, [0, 1, 1e6]), { message: /names vertex 1000000/ });
      assert.ok(mesh.report.components > 0);
      const field = mesh.field(source);
      assert.equal(field.at([0]).distance[0], field.distance[0]);
      assert.ok(field.at([inFace]).distance[0] >= 0);
      if (mesh.isolines) {
        assert.ok(mesh.isolines(field.distance, { count: 5 }).length > 0, name);
        assert.ok(mesh.path([0, 3]).length > 0, name);
        assert.ok(field.path(mesh.vertexCount - 1).length > 0, name);
        for (const format of ['ply', 'obj', 'off', 'stl']) {
          const bytes = made.write(format);
          const read = library.read(bytes, `mesh.${format}`);
          assert.equal(read.faceCount, made.faceCount, `${name}, ${format}`);
          read.free();
          assert.throws(() => library.read(bytes.subarray(0, 20), `mesh.${format}`), (e) => e.name === 'BrushfireError' && e.code !== 'internal');
        }
      }
      for (const o of [field, mesh, made]) o.free();
    }
  }
});

test('numbers have the digits that the program writes', { skip: withoutNative }, () => {
  const next = random(3);
  const numbers = [0, -0, 1, 0.1, 1e22, 1e21, 123456789012345680000, 1e-5, 0.0001, 5e-324, 2 ** -44, 2 ** 60, 9007199254740993, 1e100, 4.35, 0.3];
  for (let e = -60; e < 60; e += 1) numbers.push(2 ** e, 10 ** e);
  while (numbers.length < 3000) numbers.push((next() - 0.5) * 10 ** Math.floor(40 * next() - 20));
  const faces = [];
  for (let v = 0; v + 2 < numbers.length / 3; ++v) faces.push(v, v + 1, v + 2);
  const mesh = bf.mesh(Float64Array.from(numbers), faces);
  writeFileSync(inFolder('numbers.ply'), mesh.write('ply'));
  native('convert', inFolder('numbers.ply'), inFolder('numbers.obj'));
  const lines = (bytes) => Buffer.from(bytes).toString().split('\n').filter((l) => /^[vf] /.test(l));
  assert.deepEqual(lines(mesh.write('obj')), lines(readFileSync(inFolder('numbers.obj'))));
  mesh.free();
  // Floats as text: the bounds that glTF has in its JSON.
  for (let k = 0; k < 6; ++k) {
    const corners = Float64Array.from({ length: 9 }, (_, i) => (i < 3 ? 2 ** (7 * i - 3 * k) : (next() - 0.5) * 10 ** Math.floor(20 * next() - 10)));
    const triangle = bf.mesh(corners, [0, 1, 2]);
    writeFileSync(inFolder('floats.ply'), triangle.write('ply'));
    native('convert', inFolder('floats.ply'), inFolder('floats.glb'));
    assert.deepEqual(Buffer.from(triangle.write('glb')), readFileSync(inFolder('floats.glb')));
    triangle.free();
  }
});
