// The page in Debian's Chromium: what a visitor does, and what has to come of it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

import { bf, fileOf, folder, here, middle, place, program, save, visit, withoutNative } from './visit.js';

test('the page opens with a field, and asks nobody else for anything', async () => {
  const v = await visit();
  assert.match(await v.page.textContent('#summary'), /10242 of 10242 vertices reached.*proven/);
  await v.shot('first');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('a click sets the source, and the number under the pointer is the program\'s', { skip: withoutNative }, async () => {
  const v = await visit('#shape=torus&source=f:0:1,0,0');
  const m = await middle(v.page);
  const box = await v.page.locator('#canvas').boundingBox();
  await v.nextField(() => v.page.mouse.click(m.x, m.y + box.height * 0.2));
  await v.page.mouse.move(m.x - box.width * 0.2, m.y);
  await v.page.waitForFunction("document.getElementById('readout').dataset.distance && document.getElementById('readout').textContent.includes('path')");
  const { state, target, distance, length } = await v.page.evaluate(`({ state: brushfire.state, target: brushfire.target, distance: Number(document.getElementById('readout').dataset.distance), length: brushfire.path.length })`);
  const said = JSON.parse(execFileSync(program, ['distance', fileOf('torus', 120, 60), '--source', place(state.sources[0]), '--target', place(target), '--json'], { encoding: 'utf8' }));
  const theirs = said.targets?.[0]?.distance ?? said.target_distance?.[0] ?? said.targets?.[0];
  assert.ok(Math.abs(distance - theirs) <= 1e-12 * theirs, `${distance} here, ${JSON.stringify(said).slice(0, 400)}`);
  assert.ok(length > 0 && Math.abs(length - distance) <= 1e-3 * length, `the path is ${length} long`);
  await v.shot('path');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('shift-click adds a source, undo takes it back, dragging moves one and the field follows', async () => {
  const v = await visit();
  const m = await middle(v.page);
  await v.nextField(() => v.page.mouse.click(m.x, m.y));
  await v.page.keyboard.down('Shift');
  await v.nextField(() => v.page.mouse.click(m.x + 80, m.y + 60));
  await v.page.keyboard.up('Shift');
  assert.equal((await v.state()).sources.length, 2);
  await v.shot('two-sources');
  await v.nextField(() => v.page.click('#undo'));
  assert.equal((await v.state()).sources.length, 1);
  const before = (await v.state()).sources[0];
  await v.page.mouse.move(m.x, m.y);
  await v.page.mouse.down();
  await v.page.waitForTimeout(300);
  for (let k = 1; k <= 10; ++k) await v.page.mouse.move(m.x + 8 * k, m.y);
  await v.page.waitForTimeout(500);
  await v.page.mouse.up();
  const moved = (await v.state()).sources;
  assert.equal(moved.length, 1);
  assert.notEqual(moved[0].face, before.face);
  await v.nextField(() => v.page.click('#undo'));
  assert.deepEqual((await v.state()).sources[0], before);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('isolines and colours are drawn, and a missing isoline is noticed', async () => {
  const v = await visit('#shape=sphere&source=f:0:1,0,0');
  const dark = () => v.page.evaluate(async () => {
    const blob = await window.brushfire.scene.picture();
    const bitmap = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context_ = canvas.getContext('2d');
    context_.drawImage(bitmap, 0, 0);
    const { data } = context_.getImageData(0, 0, bitmap.width, bitmap.height);
    let ink = 0, area = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 128) continue;
      ++area;
      if (Math.max(data[i], data[i + 1], data[i + 2]) < 60) ++ink;
    }
    return { ink, area };
  });
  const lines = async (n) => {
    await v.page.locator('#lines').fill(String(n));
    await v.page.waitForTimeout(200);
    return dark();
  };
  const none = await lines(0);
  const ten = await lines(10);
  const nine = await lines(9);
  assert.ok(none.area > 50000, `the surface covers ${none.area} pixels`);
  assert.ok(ten.ink > none.ink + 1000, `${none.ink} dark pixels without lines, ${ten.ink} with`);
  assert.ok(ten.ink > nine.ink * 1.04, `${nine.ink} with nine, ${ten.ink} with ten`);
  await v.page.selectOption('#colormap', 'magma');
  await v.page.waitForTimeout(500);
  await v.shot('magma');
  await v.page.check('#cells');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('what is saved reads back, and is what the program computes', { skip: withoutNative }, async () => {
  const v = await visit('#shape=torus&source=f:7:0.2,0.3,0.5&method=exact');
  const take = async (what) => readFileSync(await save(v, what));
  const { values } = bf.readField(await take('npy'), 'distance.npy');
  const out = join(folder, 'native.npy');
  execFileSync(program, ['distance', fileOf('torus', 120, 60), '--source', 'f:7:0.2,0.3,0.5', '--method', 'exact', '-o', out]);
  const native = bf.readField(readFileSync(out), out).values;
  assert.ok(values.every((d, k) => Math.abs(d - native[k]) <= 1e-12 * native[k]));
  assert.equal(bf.read(await take('ply'), 'distance.ply').vertexCount, 7200);
  assert.match((await take('lines.svg')).toString(), /^<\?xml|<svg/);
  assert.match((await take('lines.dxf')).toString(), /AC1009/);
  assert.equal((await take('png')).subarray(1, 4).toString(), 'PNG');
  await v.page.click('#copy-command');
  const command = await v.page.evaluate('navigator.clipboard.readText()');
  assert.equal(command, 'brushfire distance torus.ply --source f:7:0.2,0.3,0.5 --method exact -o distance.npy');
  await v.page.click('#copy-python');
  assert.match(await v.page.evaluate('navigator.clipboard.readText()'), /bf\.Point\(7, \(0\.2, 0\.3, 0\.5\)\)/);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('files are opened, and a bad one shows the library\'s own words', async () => {
  const v = await visit();
  const file = fileOf('cone', 20, 40, 1, 2);
  await v.nextField(() => v.page.setInputFiles('#file', file));
  assert.match(await v.page.textContent('#report'), /821 vertices|\d+ vertices/);
  writeFileSync(join(folder, 'bad.ply'), 'ply\nformat ascii 1.0\nelement vertex 3\n');
  await v.page.setInputFiles('#file', join(folder, 'bad.ply'));
  await v.page.waitForSelector('#message:not([hidden])');
  assert.match(await v.page.textContent('#message'), /bad\.ply/);
  await v.shot('bad-file');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('two methods are compared, and the error is what the library says', async () => {
  const v = await visit('#shape=torus&source=f:7:0.2,0.3,0.5&method=novotni-klein');
  await v.nextField(() => v.page.selectOption('#against', 'exact'));
  const said = await v.page.textContent('#summary');
  const mesh = bf.shape('torus', 120, 60);
  const [field, exact] = ['novotni-klein', 'exact'].map((method) => mesh.distance([{ face: 7, weights: [0.2, 0.3, 0.5] }], { method }).distance);
  const most = Math.max(...field.map((d, k) => (exact[k] > 0 ? Math.abs(d - exact[k]) / exact[k] : 0)));
  mesh.free();
  assert.ok(most > 1e-4, `they differ by ${most}`);
  assert.ok(said.includes(`and ${(100 * most).toPrecision(2)} % at most`), said);
  assert.equal(await v.page.textContent('#legend-high'), `${(100 * most).toPrecision(2)} %`);
  const errors = await v.shot('errors');
  await v.nextField(() => v.page.selectOption('#against', ''));
  assert.notDeepEqual(await v.shot('no-errors'), errors);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('a curve is drawn, is a source, is moved, shared and saved', async () => {
  const v = await visit('#shape=sphere&source=f:0:1,0,0&method=exact');
  const m = await middle(v.page);
  await v.page.click('#draw');
  for (const [x, y] of [[-90, -60], [80, -40], [20, 90]]) {
    await v.page.mouse.click(m.x + x, m.y + y);
    await v.page.waitForTimeout(150);
  }
  await v.nextField(() => v.page.click('#close-curve'));
  const [source] = (await v.state()).sources;
  assert.equal(source.through.length, 3);
  assert.equal(source.closed, true);
  const { length, least } = await v.page.evaluate('brushfire.engine.curve(brushfire.state.sources[0]).then((c) => ({ length: c.length, least: Math.min(...brushfire.field.distance) }))');
  assert.ok(length > 0.5, `the curve is ${length} long`);
  assert.ok(least < 0.05, `its nearest vertex is ${least} away`);
  await v.shot('curve');
  await v.page.mouse.move(m.x, m.y);
  await v.page.waitForFunction("document.getElementById('readout').textContent.includes('path')");
  const [distance, pathLength] = await v.page.evaluate("[Number(document.getElementById('readout').dataset.distance), brushfire.path.length]");
  assert.ok(Math.abs(distance - pathLength) <= 1e-10, `${distance} away, a path of ${pathLength}`);
  assert.ok(readFileSync(await save(v, 'curve.json'), 'utf8').length > 100);
  const address = new URL(v.page.url()).hash;
  const sum = await v.page.evaluate('brushfire.field.distance.reduce((s, d) => s + d)');
  await v.nextField(() => v.page.click('#undo'));
  assert.equal((await v.state()).sources[0].face, 0);
  assert.deepEqual(v.complaints, []);
  await v.close();
  const w = await visit(address);
  assert.equal(await w.page.evaluate('brushfire.field.distance.reduce((s, d) => s + d)'), sum);
  await w.close();
});

test('brushfire view makes one file that works from the disk, offline', { skip: withoutNative }, async () => {
  const file = fileOf('torus', 120, 60);
  const page = join(folder, 'page.html');
  const env = { ...process.env, BRUSHFIRE_VIEWER: join(here, 'dist-single/index.html') };
  execFileSync(program, ['view', file, '--source', '5', '--method', 'windows', '--tolerance', '0.002', '-o', page], { env });
  const v = await visit(pathToFileURL(page).href, { offline: true });
  assert.match(await v.page.textContent('#summary'), /mesh\.ply: 7200 of 7200 vertices reached.*proven/);
  assert.equal(await v.page.inputValue('#tolerance'), '0.002');
  const [here_, farthest] = await v.page.evaluate('[brushfire.field.distance[5], Math.max(...brushfire.field.distance)]');
  const said = JSON.parse(execFileSync(program, ['distance', file, '--source', '5', '--tolerance', '0.002', '--json'], { encoding: 'utf8' }));
  assert.equal(here_, 0);
  assert.ok(Math.abs(said.max_distance - farthest) <= 1e-12 * farthest, `${farthest} in the page, ${said.max_distance} by the program`);
  const m = await middle(v.page);
  await v.nextField(() => v.page.mouse.click(m.x, m.y + 100));
  assert.deepEqual(v.complaints, []);
  await v.shot('single');
  await v.close();
  const { length } = gzipSync(readFileSync(join(here, 'dist-single/index.html')));
  assert.ok(length < 1.2e6, `the page without a mesh is ${length} bytes`);
});

test('the notebook\'s widget shows the page in a frame and hears of its sources', { skip: withoutNative }, async () => {
  const source = readFileSync(join(here, '../python/brushfire/_viewer.py'), 'utf8');
  const widget = /_WIDGET = """(.*?)"""/s.exec(source)[1];
  const page = join(folder, 'framed.html');
  const env = { ...process.env, BRUSHFIRE_VIEWER: join(here, 'dist-single/index.html') };
  execFileSync(program, ['view', fileOf('torus', 120, 60), '--source', '5', '-o', page], { env });
  const v = await visit();
  await v.page.evaluate(async ([code, html]) => {
    const { default: { render } } = await import(URL.createObjectURL(new Blob([code], { type: 'text/javascript' })));
    const values = { page: html, height: 400 };
    const model = { get: (name) => values[name], set: (name, value) => { values[name] = value; }, save_changes: () => { window.saved = structuredClone(values.sources); } };
    window.stop = render({ model, el: document.body.insertBefore(document.createElement('div'), document.body.firstChild) });
  }, [widget, readFileSync(page, 'utf8')]);
  await v.page.waitForFunction('window.saved', null, { timeout: 60000 });
  const [before_] = await v.page.evaluate('window.saved');
  const box = await v.page.locator('iframe').boundingBox();
  const frame = v.page.frames().find((f) => f !== v.page.mainFrame());
  const canvas = await frame.locator('#canvas').boundingBox();
  assert.equal(box.height, 400);
  await v.page.mouse.click(canvas.x + canvas.width / 2, canvas.y + canvas.height * 0.7);
  await v.page.waitForFunction((face) => window.saved[0].face !== face, before_.face);
  await v.page.evaluate('window.stop()');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('the keyboard alone does', async () => {
  const v = await visit();
  await v.page.focus('#canvas');
  const before = (await v.state()).sources[0].face;
  await v.nextField(() => v.page.keyboard.press('Enter'));
  const after_ = (await v.state()).sources;
  assert.notEqual(after_[0].face, before);
  await v.page.waitForFunction("/^Distance 0\\b/.test(document.getElementById('readout').textContent)");
  for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowUp', '+']) await v.page.keyboard.press(key);
  await v.nextField(() => v.page.keyboard.press('a'));
  assert.equal((await v.state()).sources.length, 2);
  await v.nextField(() => v.page.keyboard.press('Control+z'));
  assert.deepEqual((await v.state()).sources, after_);
  await v.page.keyboard.press('Tab');
  assert.equal(await v.page.evaluate('document.activeElement.id'), 'shape');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('a shared address shows the same', async () => {
  const v = await visit();
  const m = await middle(v.page);
  await v.nextField(() => v.page.mouse.click(m.x + 30, m.y));
  await v.nextField(() => v.page.selectOption('#method', 'novotni-klein'));
  const address = new URL(v.page.url()).hash;
  const [state, sum] = await v.page.evaluate('[brushfire.state, brushfire.field.distance.reduce((s, d) => s + d)]');
  await v.close();
  const w = await visit(address);
  assert.deepEqual(await w.state(), state);
  assert.equal(await w.page.evaluate('brushfire.field.distance.reduce((s, d) => s + d)'), sum);
  await w.close();
});

test('on a telephone, in the dark', async () => {
  const v = await visit('', { viewport: { width: 390, height: 780 }, colorScheme: 'dark', hasTouch: true });
  const { width, scroll } = await v.page.evaluate('({ width: innerWidth, scroll: document.documentElement.scrollWidth })');
  assert.ok(scroll <= width, `${scroll} wide in a window of ${width}`);
  await v.shot('telephone');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

// As it opens, and with everything in it that can be.
const FULL = '#shape=torus&source=f:7:0.2,0.3,0.5&method=novotni-klein&against=exact&beside=1&cells=1&every=0.2';
for (const [colorScheme, fragment] of [['light', ''], ['dark', ''], ['light', FULL], ['dark', FULL]]) {
  test(`axe finds nothing serious (${colorScheme}${fragment ? ', side by side' : ''})`, async () => {
    const v = await visit(fragment, { colorScheme });
    await v.page.click('details summary');
    await v.page.addScriptTag({ path: createRequire(import.meta.url).resolve('axe-core/axe.min.js') });
    const { violations } = await v.page.evaluate('axe.run()');
    const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
    assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`), []);
    await v.close();
  });
}
