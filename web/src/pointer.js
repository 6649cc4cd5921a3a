// Pointer and keyboard on the surface: sources are set, added and dragged; what is under the pointer is told.

import { handles, withHandle } from './state.js';

const NEAR = 14; // pixels: a press that near to a source takes hold of it
const STILL = 5; // pixels: a press that moved less is a click, else the view was turned

export function listen(canvas, app, { setSources, drawCurve, look, undo }) {
  let press = null;
  let hover = null;

  function take(point, adds) {
    if (app.drawing) return drawCurve([...app.drawing, point]);
    return setSources(adds ? [...app.state.sources, point] : [point]);
  }

  async function sourceAt(x, y) {
    const held = handles(app.state.sources);
    const positions = await app.engine.mesh.position(held.map(({ place }) => place));
    return held.find((_, i) => {
      const places = app.scene.onPage(...positions.subarray(3 * i, 3 * i + 3));
      return places.some((at) => Math.hypot(at.x - x, at.y - y) < NEAR);
    });
  }

  canvas.addEventListener('pointerdown', async (event) => {
    const mine = (press = { x: event.clientX, y: event.clientY, shift: event.shiftKey, held: undefined, dragged: false });
    const point = app.scene.pick(event.clientX, event.clientY);
    if (!point || event.shiftKey || app.drawing) return;
    // Turning waits for the answer, which takes a worker some milliseconds.
    app.scene.turning = false;
    const held = await sourceAt(event.clientX, event.clientY);
    if (press === mine) mine.held = held;
    app.scene.turning = press !== mine || !held;
  });
  canvas.addEventListener('pointermove', (event) => {
    if (press?.held) {
      const point = app.scene.pick(event.clientX, event.clientY);
      if (!point) return;
      setSources(withHandle(app.state.sources, press.held, point), { remember: !press.dragged });
      press.dragged = true;
      return;
    }
    if (event.buttons !== 0) return;
    clearTimeout(hover);
    hover = setTimeout(() => look(app.scene.pick(event.clientX, event.clientY)), 60);
  });
  canvas.addEventListener('pointerup', (event) => {
    app.scene.turning = true;
    const was = press;
    press = null;
    if (!was || was.dragged || Math.hypot(event.clientX - was.x, event.clientY - was.y) > STILL) return;
    const point = app.scene.pick(event.clientX, event.clientY);
    if (point) take(point, was.shift);
  });
  canvas.addEventListener('pointerleave', () => clearTimeout(hover));

  canvas.addEventListener('keydown', (event) => {
    const box = canvas.getBoundingClientRect();
    const middle = () => app.scene.pick(box.left + box.width / 2, box.top + box.height / 2);
    const step = 0.12;
    const keys = {
      ArrowLeft: () => app.scene.turn(-step, 0),
      ArrowRight: () => app.scene.turn(step, 0),
      ArrowUp: () => app.scene.turn(0, step),
      ArrowDown: () => app.scene.turn(0, -step),
      '+': () => app.scene.zoom(0.9),
      '-': () => app.scene.zoom(1 / 0.9),
      Home: () => app.scene.home(),
      Enter: () => { const p = middle(); if (p) take(p, false)?.then(() => look(app.state.sources[0])); },
      Escape: () => app.drawing && drawCurve(null),
      a: () => { const p = middle(); if (p) take(p, true); },
      ' ': () => look(middle()),
    };
    if ((event.ctrlKey || event.metaKey) && event.key === 'z') undo();
    else if (keys[event.key] && !event.ctrlKey && !event.metaKey) keys[event.key]();
    else return;
    event.preventDefault();
  });
}

export function openFiles(stage, input, openFile) {
  input.addEventListener('change', () => input.files[0] && openFile(input.files[0]));
  const over = (on) => (event) => {
    event.preventDefault();
    stage.classList.toggle('dropping', on);
  };
  document.addEventListener('dragover', over(true));
  document.addEventListener('dragleave', over(false));
  document.addEventListener('drop', (event) => {
    over(false)(event);
    if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
  });
}
