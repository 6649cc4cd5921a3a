// What the visitor takes along: the bytes that the program would write.
import { curveFile } from './code.js';
import { spacingOf } from './isolines.js';
import { isCurve } from './state.js';

function download(bytes, name, type = 'application/octet-stream') {
  const url = URL.createObjectURL(bytes instanceof Blob ? bytes : new Blob([bytes], { type }));
  const link = Object.assign(document.createElement('a'), { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

// Isolines as they are drawn: exact arcs where these are.
async function isolines({ engine, field, arcs, farthest, state }) {
  const every = spacingOf(state, farthest);
  if (!(every > 0)) throw new Error('There are no isolines: choose how many, or how far apart.');
  return arcs ?? engine.ground.mesh.isolines((field.drawn ?? field).distance, { every });
}

export async function save(app, what) {
  const { engine, field, path, scene, sides, state } = app;
  const { mesh, ground } = engine;
  const [name, format] = what.split('.');
  const curves = async (list, as) => download(await mesh.writeCurves(format, list.map((c) => ground.onWhole(c))), as);
  if (what === 'png') return download(await scene.picture(), 'picture.png');
  if (what === 'npy' || what === 'ply') {
    const values = sides ? (await ground.whole(sides, new Int32Array(sides.length))).distance : field.distance;
    return download(await mesh.write(what, { values, ...(what === 'ply' && { labels: field.source }) }), `distance.${what}`);
  }
  if (name === 'path') {
    if (!path) throw new Error('Point at the surface first: the path under the pointer is saved.');
    return curves([path], `path.${format}`);
  }
  if (what === 'walls.txt') {
    const { edges } = ground;
    if (edges.length === 0) throw new Error('Draw a wall first.');
    const pairs = Array.from({ length: edges.length / 2 }, (_, k) => `${edges[2 * k]} ${edges[2 * k + 1]}\n`);
    return download(new TextEncoder().encode(pairs.join('')), 'walls.txt');
  }
  if (name === 'curve') {
    const k = state.sources.findIndex(isCurve);
    if (k < 0) throw new Error('Draw a curve first.');
    return curves([await engine.curve(state.sources[k])], curveFile(k).replace('json', format));
  }
  return curves(await isolines(app), `isolines.${format}`);
}
