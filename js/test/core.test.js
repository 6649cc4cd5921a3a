// The entry of the solvers only, and how large both are.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';

import { load } from '../lib/core.js';
import { bf, difference, meshes, package_ } from './support.js';

const core = await load();

test('brushfire/core gives the same bits', () => {
  for (const [name, make, source] of meshes) {
    const mesh = make();
    const other = core.mesh(mesh.vertices, mesh.faces);
    for (const method of core.methods) {
      assert.equal(difference(other.distance(source, { method }).distance, mesh.distance(source, { method }).distance), 0, `${name}, ${method}`);
    }
    const field = other.field(source);
    assert.equal(field.at([0]).distance[0], field.distance[0]);
    for (const o of [field, other, mesh]) o.free();
  }
  assert.equal(core.version, bf.version);
});

const lib = join(package_, 'lib');
const packed = (names) => names.reduce((sum, name) => sum + gzipSync(readFileSync(join(lib, name)), { level: 9 }).length, 0);

// The scripts that a page fetches for an entry: what it imports, and what that imports.
function scriptsOf(name, found = new Set()) {
  if (found.has(name)) return found;
  found.add(name);
  const text = readFileSync(join(lib, name), 'utf8');
  for (const [, imported] of text.matchAll(/from '\.\/([^']+)'/g)) scriptsOf(imported, found);
  if (text.includes("from '#platform'")) found.add('platform.web.js');
  return found;
}

// What they may not grow beyond: what a page waits for (aims: 450 and 250 kB), and what comes behind it. docs/decisions/web.md.
const MOST = { whole: 426e3, core: 242e3, wholeRest: 357e3, coreRest: 204e3 };

test('the package has not grown', (t) => {
  const whole = packed(['brushfire.wasm', ...scriptsOf('index.js'), 'worker.js']);
  const small = packed(['core.wasm', ...scriptsOf('core.js')]);
  const wholeRest = packed(['brushfire.rest.wasm']);
  const coreRest = packed(['core.rest.wasm']);
  const kB = (size) => `${(size / 1000).toFixed(1)} kB`;
  t.diagnostic(`gzipped: brushfire ${kB(whole)} and ${kB(wholeRest)} behind it, core ${kB(small)} and ${kB(coreRest)}`);
  for (const [name, size] of Object.entries({ whole, core: small, wholeRest, coreRest })) {
    assert.ok(size < MOST[name], `${name}: ${size} bytes`);
  }
});
