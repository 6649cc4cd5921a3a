// What the visitor takes along: the bytes that the program would write.
import { curveFile, isCurve } from './state.js';

function download(bytes, name, type = 'application/octet-stream') {
  const url = URL.createObjectURL(bytes instanceof Blob ? bytes : new Blob([bytes], { type }));
  const link = Object.assign(document.createElement('a'), { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export async function save({ engine, field, path, scene, state }, what) {
  const { mesh } = engine;
  if (what === 'png') return download(await scene.picture(), 'picture.png');
  if (what === 'npy' || what === 'ply') {
    return download(await mesh.write(what, { values: field.distance, ...(what === 'ply' && { labels: field.source }) }), `distance.${what}`);
  }
  if (what === 'path.obj') {
    if (!path) throw new Error('Point at the surface first: the path under the pointer is saved.');
    return download(await mesh.writeCurves('obj', [path]), 'path.obj');
  }
  if (what === 'walls.txt') {
    const { edges } = engine.ground;
    if (edges.length === 0) throw new Error('Draw a wall first.');
    const pairs = Array.from({ length: edges.length / 2 }, (_, k) => `${edges[2 * k]} ${edges[2 * k + 1]}\n`);
    return download(new TextEncoder().encode(pairs.join('')), 'walls.txt');
  }
  if (what === 'curve.json') {
    const k = state.sources.findIndex(isCurve);
    if (k < 0) throw new Error('Draw a curve first.');
    return download(await mesh.writeCurves('json', [await engine.curve(state.sources[k])]), curveFile(k));
  }
  const format = what.split('.')[1];
  const farthest = field.distance.reduce((most, d) => (Number.isFinite(d) && d > most ? d : most), 0);
  const lines = await mesh.isolines(field.distance, { every: farthest / Math.max(1, state.lines) });
  return download(await mesh.writeCurves(format, lines), `isolines.${format}`);
}
