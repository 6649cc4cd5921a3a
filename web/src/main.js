// The page: what the visitor does changes the state, and the state is shown.
import { asCommand, asPython } from './code.js';
import { compared, percent } from './comparison.js';
import { Engine } from './engine.js';
import { save } from './exports.js';
import { heldMesh, tellFrame } from './held.js';
import { arcsOf, canBeArcs, spacingOf } from './isolines.js';
import { showLabels } from './panes.js';
import { listen, openFiles } from './pointer.js';
import { sentence, showReport } from './report.js';
import { Scene } from './scene.js';
import { ERROR, FIELD, OTHER } from './shader.js';
import { computationsOf, fromFragment, handles, History, initial, isCurve, SHAPES, solving, tidy, toFragment } from './state.js';

const $ = (id) => document.getElementById(id);
const METHODS = ['windows', 'exact', 'novotni-klein', 'carried-source', 'kimmel-sethian', 'novotni-klein-2002', 'dijkstra'];
const number = (x) => (Number.isFinite(x) ? Number(x.toPrecision(7)).toString() : 'unreachable');

export const app = { state: fromFragment(location.hash) ?? initial(), history: new History(), scene: null, engine: null, field: null, path: null, arcs: null, drawing: null, drawsWall: false, file: null };

function say(error) {
  $('message').textContent = error ? String(error.message ?? error) : '';
  $('message').hidden = !error;
}

async function guarded(run) {
  say(null);
  return attempt(run);
}

// What is said already stays.
async function attempt(run) {
  try {
    return await run();
  } catch (error) {
    if (error.code !== 'cancelled') say(error);
    return undefined;
  }
}

export async function open(make, name, file, values) {
  const opened = await guarded(() => app.engine.open(make));
  if (!opened) return;
  app.file = file ?? null;
  app.name = name;
  const { mesh, vertices, faces, report } = opened;
  app.scene.showMesh(vertices, faces, mesh.bounds);
  $('report').textContent = sentence(mesh, report);
  showReport($('whole-report'), report);
  Object.assign(app, { vertices, faces, report });
  if (values) await showGiven(values);
  else await refresh();
}

export function openShape(name) {
  return open((pool) => pool.shape(...SHAPES[name]), name);
}

export async function openFile(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  app.state = { ...app.state, shape: '', sources: [{ face: 0, weights: [1, 0, 0] }], walls: [] };
  app.history.clear();
  return open((pool) => pool.read(bytes, file.name), file.name, bytes);
}

function openHeld({ bytes, name, state, values }) {
  app.state = { ...initial(), shape: '', ...state };
  return open((pool) => pool.read(bytes, `${name}.ply`), name, bytes, values);
}

// Values that were computed elsewhere: shown until a source is set.
function showGiven(values) {
  show();
  draw({ distance: values, source: new Int32Array(values.length), given: true });
}

// The field of the state as it is now; pictures of older ones are not drawn.
export async function refresh() {
  forget();
  show();
  const busy = setTimeout(() => { $('busy').hidden = false; }, 200);
  const { sources, walls, by } = app.state;
  if (await guarded(() => app.engine.setWalls(walls))) showGround();
  const fields = await guarded(() => app.engine.solve(sources, computationsOf(app.state)));
  const view = fields && (await guarded(() => viewOf(by, sources)));
  clearTimeout(busy);
  $('busy').hidden = true;
  if (!fields) return;
  draw(fields[0], fields[1], view);
  tellFrame(app.state.sources);
  await showArcs();
}

// The surface, cut open along the walls.
function showGround() {
  const { mesh, ground } = app.engine;
  app.scene.showMesh(ground.vertices ?? app.vertices, ground.faces ?? app.faces, mesh.bounds, true);
  app.scene.showWalls(ground.lines);
}

// What there is to see beside distances.
async function viewOf(by, sources) {
  if (by === 'sides') {
    if (!sources.some(isCurve)) throw new Error('Draw a curve first: sides are those of a curve.');
    return { sides: await app.engine.sides(sources) };
  }
  if (by === 'log map') {
    if (sources.every(isCurve)) throw new Error('Click first: the pattern is laid around a place.');
    return { chart: await app.engine.chart(sources) };
  }
  return {};
}

function showView({ sides = null, chart = null } = {}) {
  app.sides = sides;
  app.chart = chart;
  const widest = sides ? sides.reduce((most, d) => (Number.isFinite(d) ? Math.max(most, Math.abs(d)) : most), 0) : -1;
  app.scene.showSides(sides, widest);
  app.scene.showChart(chart, (app.scene.uniforms.farthest.value * Number($('tile').value)) / 100);
  if (sides) $('legend-high').textContent = `±${number(widest)}`;
  $('legend-bar').hidden = $('legend-low').hidden = sides !== null;
}

function draw(field, other, view) {
  app.field = field;
  const drawn = field.drawn ?? field;
  app.scene.showField(drawn.distance, drawn.source);
  app.farthest = field.distance.reduce((most, d) => (Number.isFinite(d) && d > most ? d : most), 0);
  app.scene.uniforms.farthest.value = app.farthest || 1;
  showSpacing();
  $('legend-high').textContent = number(app.farthest);
  const error = showComparison(drawn, other?.drawn);
  showView(view);
  const bound = Number.isFinite(field.maxErrorBound) ? `, every distance within ${percent(field.maxErrorBound)} (proven)` : '';
  $('summary').textContent = `${app.name}: ${field.distance.reduce((n, d) => n + (Number.isFinite(d) ? 1 : 0), 0)} of ${field.distance.length} vertices reached, the farthest at ${number(app.farthest)}${bound}${error}`;
  document.documentElement.dataset.solved = String(Number(document.documentElement.dataset.solved ?? 0) + 1);
}

// By how much the field differs from the other one, where there is one: as a view, between the two or alone; and in words.
function showComparison(field, other) {
  const { method, against, beside, by } = app.state;
  const { errors, mean, most } = other ? compared(field.distance, other.distance) : {};
  const isBeside = other && beside && by === 'distance';
  app.scene.panes = isBeside ? [FIELD, ERROR, OTHER] : [other ? ERROR : FIELD];
  showLabels($('views'), isBeside ? [method, `difference, ${percent(most)} at most`, against] : []);
  if (!other) return '';
  app.scene.showOther(other, errors, most);
  if (!isBeside) $('legend-high').textContent = percent(most);
  return `. Differs from ${against} by ${percent(mean)} on average and ${percent(most)} at most`;
}

function showSpacing() {
  app.scene.uniforms.spacing.value = spacingOf(app.state, app.farthest);
  app.scene.draw();
}

// In place of lines between values, once they are there.
async function showArcs() {
  const mine = ++arcsAsked;
  app.arcs = null;
  app.scene.showArcs(null);
  const { state, farthest, report } = app;
  if (!state.arcs || app.field?.given) return;
  const arcs = await attempt(async () => {
    const levels = arcsOf(state, farthest, report.meanEdgeLength);
    return levels && app.engine.arcs(state.sources, solving(state), levels);
  });
  if (mine !== arcsAsked || !arcs) return;
  app.arcs = arcs;
  app.scene.showArcs(arcs);
}
let arcsAsked = 0;

// Also a value that is none of the choices, as a page that was made for it may have.
function choose(select, value) {
  if (![...select.options].some((o) => o.value === value)) select.add(new Option(value));
  select.value = value;
}

function show() {
  const { state } = app;
  $('shape').value = state.shape;
  $('method').value = state.method;
  choose($('tolerance'), state.tolerance);
  $('against').value = state.against;
  $('beside').disabled = !state.against;
  $('arcs').disabled = !canBeArcs(state.method);
  for (const name of ['beside', 'arcs', 'cells']) $(name).checked = state[name];
  app.scene.uniforms.showCells.value = state.cells;
  $('tolerance').disabled = state.method !== 'windows';
  $('colormap').value = state.colormap;
  $('lines').value = state.lines;
  $('lines-value').textContent = state.every ? '' : state.lines;
  $('every').value = state.every;
  $('by').value = state.by;
  $('no-walls').disabled = state.walls.length === 0;
  $('undo').disabled = !app.history.canUndo;
  $('redo').disabled = !app.history.canRedo;
  history.replaceState(null, '', state.shape ? toFragment(state) : '#');
  showSources(state.sources);
}

// Curves, and the places that can be moved; what the places are that a curve is drawn through is not there to see yet.
async function showSources(sources) {
  const mine = (shown += 1);
  await guarded(async () => {
    const drawn = app.drawing?.length > 1 ? [...sources, { through: app.drawing, closed: false }] : sources;
    const places = [...handles(drawn).map(({ place }) => place), ...(app.drawing?.length === 1 ? app.drawing : [])];
    const [positions, curves] = await Promise.all([app.engine.mesh.position(places), Promise.all(drawn.filter(isCurve).map((s) => app.engine.curve(s)))]);
    if (mine === shown) app.scene.showSources(positions, curves);
  });
}
let shown = 0;

// A curve or a wall is drawn by the places that it goes through. Null: none is.
function drawCurve(places, isWall = app.drawsWall) {
  if (places) forget();
  app.drawing = places;
  app.drawsWall = places !== null && isWall;
  $('draw').setAttribute('aria-pressed', String(places !== null && !isWall));
  $('draw-wall').setAttribute('aria-pressed', String(app.drawsWall));
  for (const id of ['end-curve', 'close-curve']) $(id).disabled = !(places?.length > 1);
  const what = isWall ? 'wall' : 'curve';
  if (places) $('readout').textContent = places.length === 0 ? `Click where the ${what} goes` : `A ${what} through ${places.length} place${places.length > 1 ? 's' : ''}`;
  showSources(app.state.sources);
}

function endCurve(closed, adds) {
  const through = app.drawing.map(tidy);
  const isWall = app.drawsWall;
  drawCurve(null);
  if (isWall) return change({ walls: [...app.state.walls, { through: closed ? [...through, through[0]] : through }] });
  return setSources([...(adds ? app.state.sources : []), { through, closed }]);
}

// A change that can be undone.
export function change(parts) {
  app.history.add(app.state);
  app.state = { ...app.state, ...parts };
  return refresh();
}

export function setSources(sources, { remember = true } = {}) {
  if (remember) app.history.add(app.state);
  app.state = { ...app.state, sources: sources.map(tidy) };
  return refresh();
}

// What was said of a point holds for the sources of then.
function forget() {
  ++asked;
  app.path = null;
  app.scene.showPath(null);
  $('readout').textContent = 'Point at the surface';
}

// The number and the path at a point: exactly what the program says for it with the same options.
let asked = 0;
export async function look(point) {
  const mine = ++asked;
  if (!point || app.drawing) return;
  await guarded(async () => {
    if (app.field?.given) {
      const value = point.weights.reduce((sum, w, k) => (w > 0 ? sum + w * app.field.distance[app.faces[3 * point.face + k]] : sum), 0);
      $('readout').textContent = `Value ${number(value)}`;
      return;
    }
    const { against } = app.state;
    const { distances: [distance, other], path } = await app.engine.look(app.state.sources, computationsOf(app.state), point, $('path').checked);
    if (mine !== asked) return;
    app.target = point;
    const beside = against ? `, by ${against} ${number(other)}` : '';
    $('readout').textContent = `Distance ${number(distance)}${beside}${path ? `, path ${number(path.length)} long` : ''}`;
    Object.assign($('readout').dataset, { distance, other });
    app.path = path;
    if (path) app.scene.showPath(path.positions);
  });
}

async function colours() {
  const table = await app.engine.colormap(app.state.colormap);
  app.scene.setColours(table);
  const canvas = $('legend-bar');
  canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(table), 256, 1), 0, 0);
}

async function travel(step) {
  const state = step(app.state);
  if (!state) return;
  const before = app.state;
  app.state = state;
  if (state.colormap !== before.colormap) await colours();
  if (state.shape !== before.shape && state.shape) await openShape(state.shape);
  else await refresh();
}

function wave(on) {
  $('wave').setAttribute('aria-pressed', String(on));
  const { uniforms } = app.scene;
  if (!on) {
    uniforms.front.value = -1;
    app.scene.draw();
    return;
  }
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const begin = performance.now();
  const frame = () => {
    if ($('wave').getAttribute('aria-pressed') !== 'true') return;
    const share = still ? 0.5 : ((performance.now() - begin) / 4000) % 1.1;
    uniforms.front.value = share * uniforms.farthest.value;
    app.scene.draw();
    if (!still) requestAnimationFrame(frame);
  };
  frame();
}

function bind() {
  for (const name of Object.keys(SHAPES)) $('shape').add(new Option(name));
  $('shape').add(new Option('your file', ''));
  for (const name of METHODS) $('method').add(new Option(name));
  $('against').add(new Option('nothing', ''));
  for (const name of METHODS.filter((m) => m !== 'windows')) $('against').add(new Option(name));
  $('shape').onchange = async () => {
    if (!$('shape').value) return;
    app.history.add(app.state);
    app.state = { ...app.state, shape: $('shape').value, sources: initial().sources, walls: [] };
    await openShape(app.state.shape);
  };
  $('method').onchange = () => change({ method: $('method').value });
  $('against').onchange = () => change({ against: $('against').value });
  $('tolerance').onchange = () => change({ tolerance: $('tolerance').value });
  $('colormap').onchange = async () => { await change({ colormap: $('colormap').value }); await colours(); };
  // Where the slider was let go of before can be come back to.
  let slides = false;
  $('lines').oninput = () => {
    if (!slides) app.history.add(app.state);
    slides = true;
    app.state = { ...app.state, lines: Number($('lines').value), every: '' };
    show();
    showSpacing();
    showArcs();
  };
  $('lines').onchange = () => { slides = false; };
  $('every').onchange = () => change({ every: Number($('every').value) > 0 ? $('every').value : '' });
  for (const name of ['beside', 'arcs', 'cells']) $(name).onchange = () => change({ [name]: $(name).checked });
  $('path').onchange = () => { if (!$('path').checked) app.scene.showPath(null); };
  $('wave').onclick = () => wave($('wave').getAttribute('aria-pressed') !== 'true');
  $('draw').onclick = () => drawCurve(app.drawing ? null : [], false);
  $('draw-wall').onclick = () => drawCurve(app.drawing ? null : [], true);
  $('no-walls').onclick = () => change({ walls: [] });
  $('by').onchange = () => change({ by: $('by').value });
  $('tile').oninput = () => showView(app);
  $('decal').onchange = () => guarded(async () => {
    const [file_] = $('decal').files;
    if (!file_) return;
    app.scene.setPicture(await createImageBitmap(file_, { imageOrientation: 'flipY' }));
    $('tile').value = 60;
    await change({ by: 'log map' });
  });
  $('end-curve').onclick = (event) => endCurve(false, event.shiftKey);
  $('close-curve').onclick = (event) => endCurve(true, event.shiftKey);
  $('undo').onclick = () => travel((s) => app.history.undo(s));
  $('redo').onclick = () => travel((s) => app.history.redo(s));
  $('cancel').onclick = () => app.engine.cancel();
  $('save').onclick = () => guarded(() => save(app, $('export').value));
  const file = () => (app.state.shape ? `${app.state.shape.replace(' ', '-')}.ply` : app.name);
  for (const [id, text] of [['copy-command', asCommand], ['copy-python', asPython]]) {
    $(id).onclick = () => guarded(() => navigator.clipboard.writeText(text(app.state, file(), arcsOf(app.state, app.farthest, app.report.meanEdgeLength))));
  }
  $('controls').onsubmit = (event) => event.preventDefault();
  listen($('canvas'), app, { setSources, drawCurve, look, undo: () => $('undo').click() });
  openFiles($('stage'), $('file'), openFile);
}

window.brushfire = app; // for tests, and for who is curious
try {
  app.scene = new Scene($('canvas'));
  app.engine = await Engine.start();
  app.scene.faceOf = (face) => app.engine.ground.faceOf(face);
  bind();
  await colours();
  const held = heldMesh(document);
  if (held) await openHeld(held);
  else await openShape(app.state.shape);
} catch (error) {
  say(error);
}
