// The numbers of the package beside those of the native program, on the same files.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { test } from 'node:test';

import { bf, difference, inFolder, meshes, native, readNpy, withoutNative } from './support.js';

// Marching is in floats unless told otherwise: their rounding shows.
const MOST = { windows: 1e-12, exact: 1e-12, dijkstra: 1e-12, 'novotni-klein': 1e-6, 'novotni-klein-2002': 1e-12, 'kimmel-sethian': 1e-6, 'carried-source': 1e-6 };

for (const [name, make, source] of meshes) {
  test(`${name}: every method gives the native numbers`, { skip: withoutNative }, () => {
    using_(make(), (mesh) => {
      const file = inFolder(`${name.replace(' ', '-')}.ply`);
      writeFileSync(file, mesh.write('ply'));
      for (const method of bf.methods) {
        const out = inFolder('field.npy');
        native('distance', file, '--source', String(source), '--method', method, '-o', out);
        const field = mesh.distance(source, { method });
        const d = difference(field.distance, readNpy(out));
        assert.ok(d <= MOST[method], `${method}: off by ${d}`);
      }
    });
  });

  test(`${name}: tolerances, bounds, points, positions and offsets give the native numbers`, { skip: withoutNative }, () => {
    using_(make(), (mesh) => {
      const file = inFolder(`${name.replace(' ', '-')}.ply`);
      writeFileSync(file, mesh.write('ply'));
      const face = mesh.faceCount >> 1;
      const [x, y, z] = mesh.position(mesh.vertexCount >> 2);
      const out = inFolder('field.npy');
      const runs = [
        [['--tolerance', '1e-2'], source, { tolerance: 1e-2 }],
        [['--bound', 'upper', '--tolerance', '5e-3'], source, { bound: 'upper', tolerance: 5e-3 }],
        [['--bound', 'lower'], source, { bound: 'lower' }],
        [['--method', 'novotni-klein', '--precision', 'float64'], source, { method: 'novotni-klein', precision: 'float64' }],
        [['--method', 'exact', '--radius', '0.5'], source, { method: 'exact', maxDistance: 0.5 }],
      ];
      for (const [args, sources, options] of runs) {
        native('distance', file, '--source', String(source), ...args, '-o', out);
        const d = difference(mesh.distance(sources, options).distance, readNpy(out));
        assert.ok(d <= 1e-12, `${args.join(' ')}: off by ${d}`);
      }
      native('distance', file, '--source', `f:${face}:0.2,0.3,0.5`, '--source', `at:${x},${y},${z + 0.01}@0.25`, '--method', 'exact', '-o', out);
      const d = difference(mesh.distance([{ face, weights: [0.2, 0.3, 0.5] }, { at: [x, y, z + 0.01], offset: 0.25 }], { method: 'exact' }).distance, readNpy(out));
      assert.ok(d <= 1e-12, `places: off by ${d}`);
    });
  });
}

function using_(object, use) {
  try {
    return use(object);
  } finally {
    object.free();
  }
}
