// What the tests of the page share: Debian's Chromium, a visit, meshes as files.
import { existsSync, mkdirSync, mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { load } from 'brushfire';
import { chromium } from 'playwright-core';

import { serve } from '../../js/test/browser.js';

export const here = fileURLToPath(new URL('..', import.meta.url));
export const program = process.env.BRUSHFIRE_PROGRAM ?? join(here, '../build/release/brushfire');
export const withoutNative = existsSync(program) ? false : `${program} is not there`;
export const folder = mkdtempSync(join(tmpdir(), 'brushfire-viewer-'));
const pictures = process.env.BRUSHFIRE_SCREENSHOTS;
if (pictures) mkdirSync(pictures, { recursive: true });
export const bf = await load();
let browser, server, context;

before(async () => {
  server = await serve(join(here, 'dist'));
  browser = await chromium.launch({ executablePath: process.env.BRUSHFIRE_CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
});
after(async () => {
  await browser?.close();
  server?.close();
});

// A page, its complaints, and a wait for the next field.
export async function visit(fragment = '', options = {}) {
  context = await browser.newContext({ viewport: { width: 1000, height: 700 }, permissions: ['clipboard-read', 'clipboard-write'], acceptDownloads: true, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && !/GPU stall|GL Driver/.test(m.text()) && complaints.push(m.text()));
  page.on('pageerror', (e) => complaints.push(String(e)));
  page.on('request', (r) => !r.url().startsWith(server.url) && r.url() !== fragment && !/^(data|blob):/.test(r.url()) && complaints.push(`asked for ${r.url()}`));
  await page.goto(fragment.startsWith('file:') ? fragment : server.url + fragment);
  await page.waitForSelector('html[data-solved]', { timeout: 60000 });
  const solved = () => page.evaluate('Number(document.documentElement.dataset.solved)');
  const nextField = async (act) => {
    const n = await solved();
    await act();
    await page.waitForFunction(`Number(document.documentElement.dataset.solved) > ${n}`, null, { timeout: 60000 });
  };
  const shot = async (name) => {
    const picture = await page.screenshot();
    if (pictures) writeFileSync(join(pictures, `${name}.png`), picture);
    return picture;
  };
  const state = () => page.evaluate('window.brushfire.state');
  return { page, complaints, nextField, shot, state, close: () => context.close() };
}

export const middle = async (page) => {
  const box = await page.locator('#canvas').boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
};

export const place = ({ face, weights }) => `f:${face}:${weights.join(',')}`;

// The mesh of the page as a file for the program.
export function fileOf(...shape) {
  const mesh = bf.shape(...shape);
  const file = join(folder, 'mesh.ply');
  writeFileSync(file, mesh.write('ply'));
  mesh.free();
  return file;
}

// Saves what the page offers under this name, and returns the path.
export async function save(v, what) {
  await v.page.selectOption('#export', what);
  const [download] = await Promise.all([v.page.waitForEvent('download'), v.page.click('#save')]);
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  return path;
}
