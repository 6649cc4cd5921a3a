// The package as `npm pack` makes it, in the bundlers that pages are made with, run in a browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';

import { serve, startBrowser, withoutBrowser } from './browser.js';
import { inFolder, package_ } from './support.js';
import { run } from './consumers/page.js';

const lacking = ['vite', 'webpack', 'esbuild', 'playwright-core'].filter((name) => !existsSync(join(package_, 'node_modules', name)));
const skip = lacking.length > 0 ? `npm ci in js/ installs ${lacking.join(', ')}` : false;

const project = inFolder('consumer');
if (!skip) {
  mkdirSync(join(project, 'node_modules/brushfire'), { recursive: true });
  const [{ filename }] = JSON.parse(execFileSync('npm', ['pack', '--json', '--pack-destination', project], { cwd: package_, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  execFileSync('tar', ['xzf', join(project, filename), '--strip-components=1', '-C', join(project, 'node_modules/brushfire')]);
  cpSync(join(package_, 'test/consumers/page.js'), join(project, 'page.js'));
  writeFileSync(join(project, 'package.json'), '{"type": "module"}');
  writeFileSync(join(project, 'main.js'), main('run()'));
  writeFileSync(join(project, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
}

function main(call, imports = '') {
  return `import { run } from './page.js';\n${imports}
    ${call}.then((result) => { window.result = result; }, (error) => { window.result = { error: String(error.stack ?? error) }; });\n`;
}

const bundlers = {
  async vite() {
    const { build } = await import('vite');
    await build({ root: project, logLevel: 'error', worker: { format: 'es' }, build: { outDir: 'vite' } });
    return join(project, 'vite');
  },
  async webpack() {
    const { default: webpack } = await import('webpack');
    const folder = join(project, 'webpack');
    const stats = await new Promise((resolve, reject) => {
      webpack({ mode: 'production', context: project, entry: './main.js', output: { path: folder } }, (e, s) => (e ? reject(e) : resolve(s)));
    });
    assert.ok(!stats.hasErrors(), stats.toString('errors-only'));
    writeFileSync(join(folder, 'index.html'), '<!doctype html><script src="./main.js"></script>');
    return folder;
  },
  // It follows no URLs of workers and assets: they are named.
  async esbuild() {
    const { build } = await import('esbuild');
    const folder = join(project, 'esbuild');
    const entry = join(project, 'named.js');
    writeFileSync(entry, main("run({ full: { wasm: new URL(full, location.href), rest: new URL(fullRest, location.href) }, core: { wasm: new URL(core, location.href), rest: new URL(coreRest, location.href) }, pool: { makeWorker: () => new Worker('worker.js', { type: 'module' }) } })",
      "import full from 'brushfire/brushfire.wasm';\nimport core from 'brushfire/core.wasm';\nimport fullRest from 'brushfire/brushfire.rest.wasm';\nimport coreRest from 'brushfire/core.rest.wasm';"));
    const common = { bundle: true, format: 'esm', loader: { '.wasm': 'file' }, outdir: folder, logLevel: 'error' };
    await build({ ...common, entryPoints: { main: entry, worker: join(project, 'node_modules/brushfire/lib/worker.js') } });
    writeFileSync(join(folder, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
    return folder;
  },
};

let browser;
after(() => browser?.close());

for (const [name, bundle] of Object.entries(bundlers)) {
  test(`${name} makes a page of it that computes`, { skip }, async (t) => {
    const folder = await bundle();
    const files = readdirSync(folder, { recursive: true }).map(String);
    assert.ok(files.filter((f) => f.endsWith('.wasm')).length >= 2, files.join(' '));
    if (withoutBrowser) {
      t.diagnostic(`built, not run: ${withoutBrowser}`);
      return;
    }
    browser ??= await startBrowser();
    const server = await serve(folder);
    const page = await browser.newPage();
    const failures = [];
    page.on('pageerror', (e) => failures.push(String(e)));
    page.on('requestfailed', (r) => failures.push(r.url()));
    await page.goto(server.url);
    await page.waitForFunction('window.result', null, { timeout: 60000 });
    assert.deepEqual(await page.evaluate('window.result'), await run());
    assert.deepEqual(failures, []);
    await page.close();
    server.close();
  });
}

test('a page that is isolated cancels through shared memory', { skip: skip || withoutBrowser }, async () => {
  browser ??= await startBrowser();
  const { build } = await import('esbuild');
  const folder = join(project, 'isolated');
  const entry = join(project, 'isolated.js');
  writeFileSync(entry, `import { createPool } from 'brushfire';
    import wasm from 'brushfire/brushfire.wasm';
    import rest from 'brushfire/brushfire.rest.wasm';
    window.run = async () => {
      const pool = await createPool({ workers: 1, wasm: new URL(wasm, location.href), rest: new URL(rest, location.href), makeWorker: () => new Worker('worker.js', { type: 'module' }) });
      const mesh = await pool.shape('folded-sphere', 7);
      const stop = new AbortController();
      setTimeout(() => stop.abort(), 100);
      const code = await mesh.distance(0, { method: 'exact', signal: stop.signal }).catch((e) => e.code);
      const { reached } = await mesh.distance(0, { method: 'dijkstra' });
      return { code, reached, isolated: crossOriginIsolated };
    };`);
  await build({ bundle: true, format: 'esm', loader: { '.wasm': 'file' }, outdir: folder, logLevel: 'error', entryPoints: { main: entry, worker: join(project, 'node_modules/brushfire/lib/worker.js') } });
  writeFileSync(join(folder, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
  for (const isolated of [true, false]) {
    const server = await serve(folder, isolated ? { 'cross-origin-opener-policy': 'same-origin', 'cross-origin-embedder-policy': 'require-corp' } : {});
    const page = await browser.newPage();
    await page.goto(server.url);
    await page.waitForFunction('window.run');
    assert.deepEqual(await page.evaluate('window.run()'), { code: 'cancelled', reached: 163842, isolated });
    await page.close();
    server.close();
  }
});
