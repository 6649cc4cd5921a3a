// Curves out of the arrays that src/curves.h makes: views of common buffers, one object a curve.

// The parts from `first` on are those of add_curves().
export function curvesOf(parts, first = 0) {
  const [starts, lengths, closed, faces, weights, positions] = parts.slice(first);
  const curves = [];
  for (let k = 0; k + 1 < starts.length; ++k) {
    const [begin, end] = [starts[k], starts[k + 1]];
    curves.push({
      faces: faces.subarray(begin, end),
      weights: weights.subarray(3 * begin, 3 * end),
      positions: positions.subarray(3 * begin, 3 * end),
      length: lengths[k],
      closed: closed[k] !== 0,
    });
  }
  return curves;
}

export function isolinesOf([levels, numbers, ...parts]) {
  return curvesOf(parts).map((curve, k) => ({ ...curve, level: levels[k], levelIndex: numbers[k] }));
}
