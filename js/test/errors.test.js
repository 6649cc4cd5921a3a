// Every code that can come out of the package does, with the library's own words.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';

import { BrushfireError } from '../lib/index.js';
import { bf, inFolder, native, thrown, withoutNative } from './support.js';

const mesh = bf.shape('torus', 20, 10);
const text = (s) => new TextEncoder().encode(s);

const cases = [
  ['invalid_argument', () => mesh.distance([]), /source/],
  ['invalid_argument', () => mesh.distance(0, { tolerance: -1 }), /tolerance/],
  ['invalid_argument', () => mesh.distance(0, { method: 'quick' }), /windows.*exact.*dijkstra/],
  ['invalid_argument', () => mesh.distance(0, { bound: 'middle' }), /estimate, lower or upper/],
  ['invalid_argument', () => mesh.distance(0, { precision: 'float16' }), /float32 or float64/],
  ['invalid_argument', () => mesh.distance(0, { methd: 'exact' }), /unknown option 'methd'/],
  ['invalid_argument', () => mesh.distance({ face: 0, weights: [0.5, 0.6, 0.7] }), /weights/],
  ['invalid_argument', () => mesh.distance({ face: 0, weights: [0, 0, 0] }), /weights/],
  ['invalid_argument', () => mesh.distance('0'), /no place/],
  ['invalid_argument', () => mesh.distance(0, { tolerance: '1e-3' }), /number is needed/],
  ['invalid_argument', () => mesh.isolines([1, 2, 3], { count: 3 }), /./],
  ['invalid_argument', () => mesh.isolines(new Float64Array(mesh.vertexCount), {}), /levels, every and count/],
  ['invalid_argument', () => bf.shape('pyramid', 3), /unknown shape/],
  ['invalid_argument', () => bf.mesh([0, 0], [0, 0, 0]), /three/],
  ['invalid_argument', () => mesh.distance({ at: [100, 0, 0], within: 1 }), /more than 1/],
  ['index_out_of_range', () => mesh.distance(200), /vertex 200 does not exist: the mesh has 200 vertices/],
  ['index_out_of_range', () => mesh.distance(-1), /vertex -1 does not exist/],
  ['index_out_of_range', () => mesh.distance(1.5), /vertex 1.5 does not exist/],
  ['index_out_of_range', () => mesh.distance(NaN), /does not exist/],
  ['index_out_of_range', () => mesh.distance({ face: 400, weights: [1, 0, 0] }), /face 400 does not exist/],
  ['index_out_of_range', () => mesh.cut({ faces: [400] }), /face 400 does not exist/],
  ['invalid_mesh', () => bf.mesh([0, 0, 0], [0, 1, 2]), /./],
  ['invalid_mesh', () => bf.mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, -2]), /face 0 names vertex -2, which cannot exist/],
  ['invalid_mesh', () => bf.mesh([0, 0, 0, 1, 0, 0, 0, NaN, 0], [0, 1, 2]), /finite/],
  ['file_malformed', () => bf.read(text('ply\nformat ascii 1.0\nelement vertex 1\n'), 'a.ply'), /^a\.ply/],
  ['file_malformed', () => bf.read(new Uint8Array(0), 'a.ply'), /empty/],
  ['unknown_format', () => bf.read(text('hello, world'), 'a.doc'), /neither name nor content/],
  ['unknown_format', () => mesh.write('doc'), /known:/],
  ['cancelled', () => mesh.distance(0, { signal: AbortSignal.abort() }), /cancelled/],
  ['too_large', () => bf.shape('plane', 100000, 100000), /32-bit|GB/],
  ['too_large', () => bf.shape('noise-terrain', 12000, 12000), /needs .* GB, but .* available/],
];

for (const [code, call, message] of cases) {
  test(`${code}: ${call.toString().slice(6)}`, () => {
    const error = thrown(call);
    assert.ok(error instanceof BrushfireError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, message);
    assert.doesNotMatch(error.message, /\n/);
  });
}

test('a dense matrix that does not fit is refused before it is begun', () => {
  const large = bf.shape('icosphere', 6);
  const error = thrown(() => large.distanceMatrix());
  assert.equal(error.code, 'too_large');
  assert.match(error.message, /40962 x 40962/);
  large.free();
});

test('a run is stopped from its progress callback', () => {
  const large = bf.shape('folded-sphere', 6);
  const shares = [];
  const error = thrown(() => large.distance(0, { method: 'exact', progress: (share) => shares.push(share) < 3 }));
  assert.equal(error.code, 'cancelled');
  assert.equal(shares.length, 3);
  assert.ok(large.distance(0).reached === large.vertexCount);
  large.free();
});

test('what a progress callback throws comes out as it is, and the mesh stays usable', () => {
  const large = bf.shape('folded-sphere', 6);
  const mine = new RangeError('mine');
  assert.equal(thrown(() => large.distance(0, { progress: () => { throw mine; } })), mine);
  assert.equal(thrown(() => large.distance(0, { progress: () => { large.distance(1); } })).code, 'invalid_argument');
  assert.equal(large.distance(0).reached, large.vertexCount);
  large.free();
});

test('messages are those of the command line program', { skip: withoutNative }, () => {
  const bad = {
    'short.ply': 'ply\nformat ascii 1.0\nelement vertex 1\n',
    'index.obj': 'v 0 0 0\nv 1 0 0\nf 1 2 3\n',
    'number.off': 'OFF\n1 0 0\n0 zero 0\n',
  };
  for (const [name, content] of Object.entries(bad)) {
    writeFileSync(inFolder(name), content);
    const said = thrown(() => native('info', inFolder(name))).stderr.trim();
    assert.equal(said, `brushfire: ${thrown(() => bf.read(text(content), inFolder(name))).message}`);
  }
});
