// The hand-written types are what the package does, as the compiler sees it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { createPool } from '../lib/index.js';
import { load as loadCore } from '../lib/core.js';
import { bf, package_ } from './support.js';

const compiler = join(package_, 'node_modules/typescript/bin/tsc');

test('a strict program compiles, and wrong calls do not', { skip: existsSync(compiler) ? false : 'npm ci in js/ installs typescript' }, () => {
  const { stdout, status } = spawnSync(process.execPath, [compiler, '--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext',
    '--lib', 'es2023,dom,esnext.disposable', join(package_, 'test/types.ts')], { encoding: 'utf8', cwd: package_ });
  assert.equal(status, 0, stdout);
});

// Names in an interface of a .d.ts file.
function namesIn(file, ...interfaces) {
  const text = readFileSync(join(package_, 'lib', file), 'utf8');
  return interfaces.flatMap((name) => {
    const body = new RegExp(`interface ${name}\\b[^{]*\\{\\n([\\s\\S]*?)\\n\\}`).exec(text);
    assert.ok(body, name);
    return [...body[1].matchAll(/^ {2}(?:readonly )?(\w+)[?(:<]/gm)].map((m) => m[1]);
  });
}

const members = (object) => {
  const names = new Set(Object.getOwnPropertyNames(object));
  for (let p = Object.getPrototypeOf(object); p !== Object.prototype; p = Object.getPrototypeOf(p)) {
    for (const name of Object.getOwnPropertyNames(p)) names.add(name);
  }
  return names;
};

test('every call that the types name is there', async () => {
  const pool = await createPool({ workers: 1 });
  const mesh = bf.shape('cube', 2);
  const far = await pool.shape('cube', 2);
  const core = (await loadCore()).shape('cube', 2);
  const missing = (object, names) => names.filter((name) => !members(object).has(name) && name !== 'file');
  const common = ['MeshCalls', 'MeshFacts', 'Owned'];
  assert.deepEqual(missing(mesh, namesIn('index.d.ts', 'Mesh', ...common)), []);
  assert.deepEqual(missing(far, namesIn('index.d.ts', 'PoolMesh', ...common)), []);
  assert.deepEqual(missing(core, namesIn('core.d.ts', 'Mesh')), []);
  assert.deepEqual(missing(bf, namesIn('index.d.ts', 'Library', 'LibraryCalls')), []);
  assert.deepEqual(missing(pool, namesIn('index.d.ts', 'Pool', 'LibraryCalls')), []);
  assert.deepEqual(missing(mesh.field(0), namesIn('index.d.ts', 'Field', 'FieldCalls', 'DistanceField')), []);
  assert.deepEqual(missing(await far.field(0), namesIn('index.d.ts', 'FieldCalls', 'DistanceField')), []);
  assert.deepEqual(missing(mesh.cut({ faces: [0] }), namesIn('index.d.ts', 'Cut', 'CutFacts', 'CutCalls')), []);
  pool.close();
});
