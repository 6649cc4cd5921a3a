// Two fields of one mesh: how far the first one is from the second.

// The share by which a value differs from another one; NaN where one of them is nothing to compare with.
export const relativeError = (value, against) => (value === against ? 0 : against > 0 ? (value - against) / against : NaN);

export const percent = (share) => `${(100 * share).toPrecision(2)} %`;

// {errors (one per vertex), mean, most}, without signs but for the errors.
export function compared(values, against) {
  const errors = values.map((d, v) => relativeError(d, against[v]));
  let [sum, count, most] = [0, 0, 0];
  for (const e of errors) {
    if (Number.isNaN(e)) continue;
    sum += Math.abs(e);
    count += 1;
    most = Math.max(most, Math.abs(e));
  }
  return { errors, mean: sum / Math.max(1, count), most };
}
