/** At most so many indices of a list, evenly spaced, with the first and the last. */
export function spaced(count: number, most: number): number[] {
  if (count <= most) return Array.from({ length: count }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (count - 1)) / (most - 1)));
}

/** Decimals with which the largest value of a column has so many digits; the others are as precise. */
export function decimals(values: ArrayLike<number>, digits: number): number {
  let most = 0;
  for (let i = 0; i < values.length; i += 1) most = Math.max(most, Math.abs(values[i]!) || 0);
  return most > 0 && most < Infinity ? Math.max(0, Math.min(12, digits - 1 - Math.floor(Math.log10(most)))) : 0;
}
