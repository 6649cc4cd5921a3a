// What is drawn and laid on the surface: walls, sides of curves, patterns by the log map; and pictures of it all, compared.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { bf, fileOf, folder, middle, place, program, save, visit, withoutNative } from './visit.js';

async function draw(v, button, places, end) {
  const m = await middle(v.page);
  await v.page.click(button);
  for (const [k, [x, y]] of places.entries()) {
    await v.page.mouse.click(m.x + x, m.y + y);
    await v.page.waitForFunction((n) => window.brushfire.drawing?.length === n, k + 1);
  }
  await v.nextField(() => v.page.click(end));
}

const WALL = [[-60, 40], [0, 60], [60, 40]];

test('a wall is drawn, distances go around it, and are the program\'s; it is shared, undone and taken away', { skip: withoutNative }, async () => {
  const v = await visit('#shape=sphere&source=f:0:1,0,0&method=exact');
  const m = await middle(v.page);
  await v.nextField(() => v.page.mouse.click(m.x, m.y + 110));
  const open = await v.page.evaluate('[...brushfire.field.distance]');
  await draw(v, '#draw-wall', WALL, '#end-curve');
  await v.shot('wall');
  const { walls, sources } = await v.state();
  assert.equal(walls.length, 1);
  const walled = await v.page.evaluate('[...brushfire.field.distance]');
  assert.ok(walled.every((d, k) => d >= open[k] - 1e-12));
  assert.ok(walled.filter((d, k) => d > 1.1 * open[k]).length > 50, 'hardly a vertex is farther away');
  const file = fileOf('icosphere', 5);
  const edges = await save(v, 'walls.txt');
  const out = join(folder, 'walled.npy');
  execFileSync(program, ['distance', file, '--source', place(sources[0]), '--method', 'exact', '--block-edges', edges, '-o', out]);
  const { values } = bf.readField(readFileSync(out), out);
  assert.ok(values.every((d, k) => Math.abs(d - walled[k]) <= 1e-12 * d));
  await v.page.click('#copy-command');
  assert.match(await v.page.evaluate('navigator.clipboard.readText()'), /--block-edges walls\.txt/);
  await v.page.mouse.move(m.x + 5, m.y + 30);
  await v.page.waitForFunction("document.getElementById('readout').textContent.includes('path')");
  const [distance, length] = await v.page.evaluate("[Number(document.getElementById('readout').dataset.distance), brushfire.path.length]");
  assert.ok(Math.abs(distance - length) <= 1e-10, `${distance} away, a path of ${length}`);
  const address = new URL(v.page.url()).hash;
  await v.nextField(() => v.page.click('#no-walls'));
  assert.deepEqual(await v.page.evaluate('[...brushfire.field.distance]'), open);
  await v.nextField(() => v.page.click('#undo'));
  assert.deepEqual(await v.page.evaluate('[...brushfire.field.distance]'), walled);
  assert.deepEqual(v.complaints, []);
  await v.close();
  const w = await visit(address);
  assert.deepEqual(await w.page.evaluate('[...brushfire.field.distance]'), walled);
  await w.close();
});

test('a closed wall keeps out what is outside', async () => {
  const v = await visit('#shape=sphere&source=f:0:1,0,0&method=exact');
  const m = await middle(v.page);
  // Off the middle, through which the edges of the wall run.
  await v.nextField(() => v.page.mouse.click(m.x + 40, m.y - 20));
  await draw(v, '#draw-wall', [[-80, -60], [80, -60], [0, 90]], '#close-curve');
  await v.shot('closed-wall');
  const reached = await v.page.evaluate('brushfire.field.distance.filter(Number.isFinite).length');
  assert.ok(reached > 100 && reached < 5000, `${reached} vertices are reached`);
  assert.match(await v.page.textContent('#summary'), new RegExp(`${reached} of 10242 vertices reached`));
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('sides of a curve have signs and colours of their own, as the program has them', { skip: withoutNative }, async () => {
  const v = await visit('#shape=sphere&source=f:0:1,0,0&method=exact');
  await v.page.selectOption('#by', 'sides');
  await v.page.waitForSelector('#message:not([hidden])');
  assert.match(await v.page.textContent('#message'), /Draw a curve first/);
  await v.nextField(() => v.page.click('#undo'));
  await draw(v, '#draw', [[-90, -60], [80, -40], [20, 90]], '#close-curve');
  await v.nextField(() => v.page.selectOption('#by', 'sides'));
  await v.shot('sides');
  const sides = await v.page.evaluate('[...brushfire.sides]');
  const curve = await save(v, 'curve.json');
  const out = join(folder, 'sides.npy');
  execFileSync(program, ['distance', fileOf('icosphere', 5), '--source', curve, '--signed', '-o', out]);
  const { values } = bf.readField(readFileSync(out), out);
  assert.ok(values.every((d, k) => Math.abs(d - sides[k]) <= 1e-9), 'the program says otherwise');
  assert.ok(sides.some((d) => d < -0.1) && sides.some((d) => d > 0.1));
  const saved = await save(v, 'npy');
  assert.deepEqual([...bf.readField(readFileSync(saved), saved).values], sides);
  await v.page.click('#copy-python');
  assert.match(await v.page.evaluate('navigator.clipboard.readText()'), /mesh\.signed_distance\(\[\*bf\.read_lines\("curve-0\.json", mesh\)\]\)/);
  assert.deepEqual(v.complaints, []);
  await v.close();
});

test('a pattern is laid on by the log map: tiles, and a picture of one\'s own', async () => {
  const v = await visit('#shape=terrain&source=f:14000:1,0,0&by=log%20map');
  const tiles = await v.shot('tiles');
  const [chart, distance] = await v.page.evaluate('[[...brushfire.chart], [...brushfire.field.distance]]');
  const wrong = distance.filter((d, k) => !(Math.abs(Math.hypot(chart[2 * k], chart[2 * k + 1]) - d) <= 2e-3 * Math.max(d, 1e-3)));
  assert.equal(wrong.length, 0, 'the coordinates are not as far from the origin as the vertices from the source');
  // A picture: red on the left, blue on the right.
  const png = await v.page.evaluate(() => {
    const canvas = Object.assign(document.createElement('canvas'), { width: 64, height: 64 });
    const context = canvas.getContext('2d');
    context.fillStyle = '#f00';
    context.fillRect(0, 0, 32, 64);
    context.fillStyle = '#00f';
    context.fillRect(32, 0, 32, 64);
    return canvas.toDataURL('image/png').split(',')[1];
  });
  await v.nextField(() => v.page.setInputFiles('#decal', { name: 'halves.png', mimeType: 'image/png', buffer: Buffer.from(png, 'base64') }));
  const pictured = await v.shot('decal');
  assert.notDeepEqual(pictured, tiles);
  const { red, blue } = await v.page.evaluate(async () => {
    const bitmap = await createImageBitmap(await window.brushfire.scene.picture());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const count = { red: 0, blue: 0 };
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 128 && data[i] > 60 && data[i + 1] < 20 && data[i + 2] < 20) ++count.red;
      if (data[i + 3] > 128 && data[i + 2] > 60 && data[i + 1] < 20 && data[i] < 20) ++count.blue;
    }
    return count;
  });
  assert.ok(red > 3000 && blue > 3000, `${red} red and ${blue} blue pixels`);
  assert.deepEqual(v.complaints, []);
  await v.close();
});
