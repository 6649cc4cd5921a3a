// Isolines: how far apart they are, and which of them can be exact arcs.

// 0: there are none.
export const spacingOf = ({ lines, every }, farthest) => Number(every) || (lines > 0 ? farthest / lines : 0);

// Only these two know how distances run inside of faces.
export const canBeArcs = (method) => method === 'windows' || method === 'exact';

const MOST = 1000;

// How arcs are asked for: chords within a hundredth of an edge, in digits that can be copied.
export function arcsOf(state, farthest, meanEdge) {
  const every = spacingOf(state, farthest);
  if (!state.arcs || !canBeArcs(state.method) || state.by === 'log map' || !(every > 0)) return null;
  if (farthest / every > MOST) throw new Error(`Isolines every ${every} would be more than ${MOST}: a larger spacing is needed for exact arcs.`);
  return { every, chordError: Number((0.01 * meanEdge).toPrecision(2)) };
}
