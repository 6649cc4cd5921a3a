// What does the same on the command line, and in Python.
import { digits, isCurve, placeText, solving } from './state.js';

// What the page calls the file of a drawn curve.
export const curveFile = (k) => `curve-${k}.json`;

const quoted = (text) => (/^[\w.+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

// `arcs`: {every, chordError} where exact arcs are drawn.
export function asCommand(state, file, arcs = null) {
  const options = solving(state);
  const sources = state.sources.map((s, k) => `--source ${isCurve(s) ? curveFile(k) : placeText(s)}`);
  const walls = state.walls.length > 0 ? ['--block-edges walls.txt'] : [];
  const by = ({ method, tolerance }) => [`--method ${method}`, ...(tolerance === undefined ? [] : [`--tolerance ${tolerance}`])];
  const words = (verb, ...parts) => ['brushfire', verb, quoted(file), ...sources, ...parts, ...walls].join(' ');
  if (state.by === 'sides') return `${words('distance', '--signed')} -o distance.npy`;
  const mine = by({ ...options, tolerance: options.tolerance === undefined ? undefined : state.tolerance });
  const lines = [`${words('distance', ...mine)} -o distance.npy`];
  if (state.against) lines.push(`${words('distance', ...by({ method: state.against }))} -o against.npy`, 'brushfire compare distance.npy against.npy');
  if (arcs) lines.push(`${words('isolines', ...mine, `--every ${arcs.every} --chord-error ${arcs.chordError}`)} -o isolines.obj`);
  return lines.join('\n');
}

export function asPython(state, file, arcs = null) {
  const options = solving(state);
  const places = state.sources.map((s, k) => (isCurve(s) ? `*bf.read_lines("${curveFile(k)}", mesh)` : `bf.Point(${s.face}, (${s.weights.map(digits).join(', ')}))`));
  const walls = state.walls.length > 0 ? '.walled(edges=np.loadtxt("walls.txt", dtype=int))' : '';
  const lines = [...(walls ? ['import numpy as np'] : []), 'import brushfire as bf', '', `mesh = bf.read(${JSON.stringify(file)})${walls}`];
  if (state.by === 'sides') return `${[...lines, `d = mesh.signed_distance([${places.join(', ')}])`].join('\n')}\n`;
  const tolerance = options.tolerance === undefined ? '' : `, tolerance=${state.tolerance}`;
  lines.push(`sources = [${places.join(', ')}]`, `d = mesh.distance(sources, method="${options.method}"${tolerance})`);
  if (state.against) lines.push(`e = mesh.distance(sources, method="${state.against}")`, 'print(bf.compare(d, e).relative)');
  if (arcs) lines.push(`arcs = mesh.curved_isolines(sources, every=${arcs.every}, chord_error=${arcs.chordError}${tolerance})`);
  return `${lines.join('\n')}\n`;
}
