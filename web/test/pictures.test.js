// The surface as it is drawn, compared with pictures that somebody has looked at (test/golden). BRUSHFIRE_GOLDEN=renew
// writes them anew: look at them then.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { here, visit } from './visit.js';
import { differing } from './pictures.js';

const golden = join(here, 'test/golden');
const renew = process.env.BRUSHFIRE_GOLDEN === 'renew';

// A share of the surface's pixels. One isoline of the twelve on the sphere is ten times as much.
const MOST = 5e-4;

// Lines lie where doubles say; how they are smoothed is up to the machine.
const SCENES = {
  isolines: '#shape=sphere&source=f:3100:1,0,0&method=exact&lines=12',
  errors: '#shape=torus&source=f:7:0.2,0.3,0.5&method=novotni-klein&against=exact&lines=0&colours=magma',
  sides: '#shape=saddle&source=loop:f:3240:1,0,0;f:3320:1,0,0;f:9680:1,0,0&method=exact&by=sides',
  walls: '#shape=terrain&source=f:14000:1,0,0&method=exact&wall=f:9000:1,0,0;f:12000:1,0,0;f:16000:1,0,0',
  beside: '#shape=torus&source=f:7:0.2,0.3,0.5&method=dijkstra&against=exact&beside=1&lines=10',
  arcs: '#shape=cube&source=f:2500:1,0,0&source=f:9000:1,0,0&method=exact&lines=12&arcs=1',
  cells: '#shape=sphere&source=f:3100:1,0,0&source=f:3300:1,0,0&source=f:2100:1,0,0&method=exact&lines=0&cells=1',
  tiles: '#shape=saddle&source=f:6400:1,0,0&method=exact&by=log+map',
};

// Of one size, whatever room the words below it leave.
const picture = (page) => page.evaluate(async () => {
  const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
  Object.assign(document.getElementById('canvas').parentElement.style, { position: 'fixed', width: '628px', height: '458px' });
  for (let i = 0; i < 3; ++i) await frame();
  const bytes = new Uint8Array(await (await window.brushfire.scene.picture()).arrayBuffer());
  return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(''));
});

for (const [name, fragment] of Object.entries(SCENES)) {
  test(`${name} are drawn as before`, async () => {
    const v = await visit(fragment, { viewport: { width: 900, height: 520 } });
    await v.page.waitForFunction('!brushfire.state.arcs || brushfire.arcs');
    const now = await picture(v.page);
    const file = join(golden, `${name}.png`);
    if (renew) {
      mkdirSync(golden, { recursive: true });
      writeFileSync(file, Buffer.from(now, 'base64'));
    }
    assert.ok(existsSync(file), `${file} is not there`);
    const { different, compared } = await differing(v.page, readFileSync(file).toString('base64'), now);
    assert.ok(compared > 10000, `the surface has ${compared} pixels`);
    assert.ok(different <= MOST * compared, `${different} of ${compared} pixels differ`);
    assert.deepEqual(v.complaints, []);
    await v.close();
  });
}

test('a missing isoline is a difference, and so is one that is elsewhere', async () => {
  const v = await visit(SCENES.isolines, { viewport: { width: 900, height: 520 } });
  const now = await picture(v.page);
  const changed = async (change) => {
    await v.page.evaluate(change);
    const { different, compared } = await differing(v.page, now, await picture(v.page));
    return different / compared;
  };
  // The ninth line, which is in sight: values near its level are drawn as if they were between two lines.
  const without = await changed(() => {
    const { scene, field } = window.brushfire;
    const step = scene.uniforms.spacing.value;
    scene.showField(field.distance.map((d) => (Math.abs(d / step - 9) < 0.5 ? (d > 9 * step ? 9.5 : 8.5) * step : d)), field.source);
  });
  assert.ok(without > 2 * MOST, `without one line ${without} of the pixels differ`);
  const moved = await changed(() => {
    const { scene, field } = window.brushfire;
    scene.showField(field.distance, field.source);
    scene.uniforms.spacing.value *= 1.03;
  });
  assert.ok(moved > 2 * MOST, `with moved lines ${moved} of the pixels differ`);
  await v.close();
});
