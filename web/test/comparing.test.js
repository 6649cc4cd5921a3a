// Two methods side by side, isolines by their spacing and as exact arcs, the wave, cells, the mesh's report.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { bf, fileOf, folder, place, program, save, visit, withoutNative } from './visit.js';

const SOURCE = 'f:7:0.2,0.3,0.5';
const labels = (v) => v.page.locator('#views li').allTextContents();
const json = (...args) => JSON.parse(execFileSync(program, [...args, '--json'], { encoding: 'utf8' }));

// Positions of an OBJ, and how its lines go through them.
function objOf(file) {
  const lines = readFileSync(file, 'utf8').split('\n').map((l) => l.trim().split(/\s+/));
  const numbers = (kind) => lines.filter(([k]) => k === kind).map(([, ...rest]) => rest.map(Number));
  return { positions: numbers('v'), lines: numbers('l') };
}

function sameObj(a, b, most) {
  const [p, q] = [objOf(a), objOf(b)];
  assert.ok(p.lines.length > 3, `${p.lines.length} lines`);
  assert.deepEqual(p.lines, q.lines);
  const off = Math.max(...p.positions.flatMap((at, k) => at.map((x, i) => Math.abs(x - q.positions[k][i]))));
  assert.ok(off <= most, `${off} off`);
}

// Of each of `count` views of the canvas, its colours on the surface in the mean.
const meanColours = (v, count) => v.page.evaluate(async (n) => {
  const bitmap = await createImageBitmap(await window.brushfire.scene.picture());
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  const means = Array.from({ length: n }, () => ({ pixels: 0, colour: [0, 0, 0] }));
  for (let i = 0; i < data.length; i += 4) {
    if (data[i + 3] < 128) continue;
    const mean = means[Math.floor((((i / 4) % bitmap.width) * n) / bitmap.width)];
    mean.pixels += 1;
    mean.colour.forEach((_, c) => { mean.colour[c] += data[i + c]; });
  }
  return means.map(({ pixels, colour }) => ({ pixels, colour: colour.map((c) => c / pixels) }));
}, count);

test('two methods are side by side with one camera, and the difference is between them', { skip: withoutNative }, async () => {
  const v = await visit(`#shape=sphere&source=${SOURCE}&method=dijkstra`);
  assert.equal(await v.page.isDisabled('#beside'), true);
  await v.nextField(() => v.page.selectOption('#against', 'exact'));
  await v.nextField(() => v.page.check('#beside'));
  const mesh = bf.shape('icosphere', 5);
  const [field, exact] = ['dijkstra', 'exact'].map((method) => mesh.distance([{ face: 7, weights: [0.2, 0.3, 0.5] }], { method }).distance);
  mesh.free();
  const most = Math.max(...field.map((d, k) => (exact[k] > 0 ? Math.abs(d - exact[k]) / exact[k] : 0)));
  assert.deepEqual(await labels(v), ['dijkstra', `difference, ${(100 * most).toPrecision(2)} % at most`, 'exact']);
  await v.shot('side-by-side');
  const [left, middle, right] = await meanColours(v, 3);
  for (const { pixels } of [left, middle, right]) assert.ok(pixels > 5000 && Math.abs(pixels - left.pixels) < 0.02 * left.pixels, `${pixels} pixels, ${left.pixels} on the left`);
  const apart = (a, b) => Math.hypot(...a.colour.map((c, k) => c - b.colour[k]));
  assert.ok(apart(left, right) > 0.2, `the two fields are ${apart(left, right)} apart`);
  assert.ok(apart(left, middle) > 1.5 * apart(left, right), `the difference looks like a field: ${apart(left, middle)}, ${apart(left, right)}`);
  // The same place in each view.
  const box = await v.page.locator('#canvas').boundingBox();
  const at = (k) => [box.x + ((k + 0.5) * box.width) / 3, box.y + box.height * 0.54];
  const [a, b, c] = await v.page.evaluate((places) => places.map(([x, y]) => window.brushfire.scene.pick(x, y)), [0, 1, 2].map(at));
  assert.deepEqual([b.face, c.face], [a.face, a.face]);
  await v.page.mouse.move(...at(2));
  await v.page.waitForFunction("document.getElementById('readout').textContent.includes('path')");
  const { state, target, said } = await v.page.evaluate("({ state: brushfire.state, target: brushfire.target, said: { ...document.getElementById('readout').dataset } })");
  const file = fileOf('icosphere', 5);
  for (const [method, number] of [['dijkstra', said.distance], ['exact', said.other]]) {
    const { targets: [{ distance }] } = json('distance', file, '--source', place(state.sources[0]), '--target', place(target), '--method', method);
    assert.ok(Math.abs(Number(number) - distance) <= 1e-12 * distance, `${method}: ${number} here, ${distance}`);
  }
  assert.match(await v.page.textContent('#readout'), /Distance .*, by exact /);
  // A click in the last one sets the source of all, and a source is taken hold of in any.
  await v.nextField(() => v.page.mouse.click(...at(2)));
  assert.equal((await v.state()).sources[0].face, a.face);
  const address = new URL(v.page.url()).hash;
  await v.page.click('#copy-command');
  const commands = (await v.page.evaluate('navigator.clipboard.readText()')).split('\n');
  assert.equal(commands.length, 3);
  const { max_relative: theirs } = (() => {
    const [one, two] = commands.slice(0, 2).map((line) => line.split(' ').map((word) => ({ brushfire: undefined, 'sphere.ply': file, 'distance.npy': join(folder, 'one.npy'), 'against.npy': join(folder, 'two.npy') })[word] ?? word).slice(1));
    for (const args of [one, two]) execFileSync(program, args);
    return json('compare', join(folder, 'one.npy'), join(folder, 'two.npy'));
  })();
  const ours = await v.page.evaluate('brushfire.scene.uniforms.worst.value');
  assert.ok(Math.abs(ours - theirs) <= 1e-9, `${ours} here, the copied commands say ${theirs}`);
  await v.nextField(() => v.page.uncheck('#beside'));
  assert.deepEqual(await labels(v), []);
  await v.nextField(() => v.page.click('#undo'));
  assert.equal((await labels(v)).length, 3);
  assert.deepEqual(v.complaints, []);
  await v.close();
  const w = await visit(address);
  assert.equal((await labels(w)).length, 3);
  await w.close();
});

test('on a telephone the views are one below the other', async () => {
  const v = await visit(`#shape=torus&source=${SOURCE}&method=dijkstra&against=exact&beside=1`, { viewport: { width: 390, height: 900 }, hasTouch: true });
  const boxes = await Promise.all([0, 1, 2].map((k) => v.page.locator('#views li').nth(k).boundingBox()));
  assert.ok(boxes[0].x === boxes[2].x && boxes[0].y < boxes[1].y && boxes[1].y < boxes[2].y);
  await v.shot('side-by-side-telephone');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('isolines by their spacing are those of the program', { skip: withoutNative }, async () => {
  const v = await visit(`#shape=torus&source=${SOURCE}&method=exact&lines=5`);
  await v.page.fill('#every', '0.15');
  await v.nextField(() => v.page.press('#every', 'Enter'));
  assert.equal(await v.page.evaluate('brushfire.scene.uniforms.spacing.value'), 0.15);
  await v.shot('spacing');
  const out = join(folder, 'spaced.obj');
  execFileSync(program, ['isolines', fileOf('torus', 120, 60), '--source', SOURCE, '--method', 'exact', '--every', '0.15', '-o', out]);
  sameObj(await save(v, 'lines.obj'), out, 1e-12);
  const address = new URL(v.page.url()).hash;
  // By count again: the slider takes its place, and undo gives it back.
  await v.page.locator('#lines').fill('7');
  assert.equal(await v.page.inputValue('#every'), '');
  const [spacing, farthest] = await v.page.evaluate('[brushfire.scene.uniforms.spacing.value, brushfire.farthest]');
  assert.equal(spacing, farthest / 7);
  await v.nextField(() => v.page.click('#undo'));
  assert.equal(await v.page.inputValue('#every'), '0.15');
  assert.deepEqual(v.complaints, []);
  await v.close();
  const w = await visit(address);
  assert.equal(await w.page.evaluate('brushfire.scene.uniforms.spacing.value'), 0.15);
  await w.close();
});

test('exact arcs are drawn and saved, and are the program\'s', { skip: withoutNative }, async () => {
  const v = await visit(`#shape=cube&source=${SOURCE}&method=exact&every=0.2`);
  const arcs = () => v.page.waitForFunction('brushfire.arcs');
  await v.page.check('#arcs');
  await arcs();
  await v.shot('arcs');
  const chordError = (await v.page.evaluate('brushfire.report.meanEdgeLength')) / 100;
  await v.page.click('#copy-command');
  const command = (await v.page.evaluate('navigator.clipboard.readText()')).split('\n').at(-1);
  const [, error] = /--every 0\.2 --chord-error (\S+) -o isolines\.obj$/.exec(command);
  assert.ok(Math.abs(Number(error) - chordError) < 0.05 * chordError);
  const out = join(folder, 'arcs.obj');
  const file = fileOf('cube', 40);
  execFileSync(program, ['isolines', file, '--source', SOURCE, '--method', 'exact', '--every', '0.2', '--chord-error', error, '-o', out]);
  sameObj(await save(v, 'lines.obj'), out, 1e-10);
  await v.page.click('#copy-python');
  assert.match(await v.page.evaluate('navigator.clipboard.readText()'), /mesh\.curved_isolines\(sources, every=0\.2, chord_error=/);
  // They follow the source, and are only of methods that have some.
  const before = await v.page.evaluate('brushfire.arcs.reduce((sum, a) => sum + a.length, 0)');
  const box = await v.page.locator('#canvas').boundingBox();
  await v.nextField(() => v.page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.6));
  await arcs();
  assert.notEqual(await v.page.evaluate('brushfire.arcs.reduce((sum, a) => sum + a.length, 0)'), before);
  await v.nextField(() => v.page.selectOption('#method', 'novotni-klein'));
  assert.equal(await v.page.isDisabled('#arcs'), true);
  assert.equal(await v.page.evaluate('brushfire.scene.uniforms.hasArcs.value'), false);
  await v.nextField(() => v.page.click('#undo'));
  await arcs();
  // Too many of them are refused in words.
  await v.page.fill('#every', '1e-5');
  await v.nextField(() => v.page.press('#every', 'Enter'));
  await v.page.waitForSelector('#message:not([hidden])');
  assert.match(await v.page.textContent('#message'), /a larger spacing/);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('exact arcs end at walls', async () => {
  const v = await visit(`#shape=terrain&source=f:14000:1,0,0&method=exact&lines=10&arcs=1&wall=f:9000:1,0,0;f:12000:1,0,0;f:16000:1,0,0`);
  await v.page.waitForFunction('brushfire.arcs');
  await v.shot('arcs-wall');
  const levels = await v.page.evaluate('[...new Set(brushfire.arcs.map((a) => a.levelIndex))].length');
  assert.ok(levels >= 9, `${levels} levels`);
  assert.ok(objOf(await save(v, 'lines.obj')).lines.length >= levels);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('the wave runs, and stands still where motion is not wanted', async () => {
  for (const reducedMotion of ['no-preference', 'reduce']) {
    const v = await visit('#shape=sphere&source=f:0:1,0,0', { reducedMotion });
    const front = () => v.page.evaluate('brushfire.scene.uniforms.front.value / brushfire.farthest');
    assert.ok((await front()) < 0);
    await v.page.click('#wave');
    assert.equal(await v.page.getAttribute('#wave', 'aria-pressed'), 'true');
    if (reducedMotion === 'reduce') {
      await v.page.waitForTimeout(500);
      assert.equal(await front(), 0.5);
    } else {
      for (let k = 0; k < 3; ++k) await v.page.waitForFunction((was) => window.brushfire.scene.uniforms.front.value / window.brushfire.farthest !== was, await front());
    }
    await v.shot(`wave-${reducedMotion}`);
    await v.page.click('#wave');
    assert.ok((await front()) < 0);
    assert.deepEqual(v.complaints, []);
    await v.close();
  }
});

test('the whole report of a mesh is there to read', async () => {
  const v = await visit('#shape=torus&source=f:0:1,0,0');
  await v.page.click('details summary');
  const said = await v.page.evaluate("Object.fromEntries([...document.querySelectorAll('#whole-report dt')].map((d) => [d.textContent, d.nextElementSibling.textContent]))");
  const mesh = bf.shape('torus', 120, 60);
  const { report } = mesh;
  mesh.free();
  assert.equal(said['euler characteristic'], '0');
  assert.equal(said['looks like soup'], 'no');
  assert.equal(said.area, Number(report.area.toPrecision(6)).toString());
  assert.equal(Object.keys(said).length, Object.keys(report).length - 1); // remarks are in the sentence
  await v.shot('report');
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('paths and curves are saved for drawing programs', async () => {
  const v = await visit('#shape=sphere&source=curve:f:0:1,0,0;f:900:1,0,0&method=exact');
  const box = await v.page.locator('#canvas').boundingBox();
  await v.page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.6);
  await v.page.waitForFunction("document.getElementById('readout').textContent.includes('path')");
  for (const what of ['path.svg', 'path.dxf', 'path.obj', 'curve.obj', 'lines.svg']) {
    const text = readFileSync(await save(v, what), 'utf8');
    assert.match(text, { svg: /<svg[^]*<(path|polyline|polygon)/, dxf: /AC1009[^]*POLYLINE/, obj: /^v [^]*^l /m }[what.split('.')[1]], what);
  }
  assert.deepEqual(v.complaints, []);
  await v.close();
});
