/** The map of the spectra: what is made of the rows of `freestand spectrum` without rocking again. */

/** Rows of `freestand spectrum` as columns, in the order motion, height, thickness. */
export interface SpectrumColumns {
  motion: string[];
  height_m: number[];
  thickness_m: number[];
  outcome: string[];
  uplift_m: (number | null)[];
  edge_acceleration_g?: (number | null)[];
  ceiling_g?: (number | null)[];
}

/** What the map shows: the uplift or the shock. */
export type Quantity = 'uplift' | 'shock';

/** The objects of a grid under some motions. A value is infinite where the object falls. */
export interface Field {
  motions: string[];
  heights: number[];
  thicknesses: number[];
  /** One array for each object, in the order of the motions; NaN where nothing could be calculated. */
  uplift: Float64Array[];
  shock: Float64Array[];
  /** The same, sorted, without those that could not be calculated. */
  sorted: Record<Quantity, Float64Array[]>;
  ceiling: Float64Array;
  lifted: Uint16Array;
  fallen: Uint16Array;
}

const hasFallen = (outcome: string) => outcome === 'overturned' || outcome === 'leaned';

/** The rows of an answer by object. */
export function field(rows: SpectrumColumns): Field {
  const motions = [...new Set(rows.motion)];
  const heights = [...new Set(rows.height_m)];
  const thicknesses = [...new Set(rows.thickness_m)];
  const objects = heights.length * thicknesses.length;
  const empty = () => Array.from({ length: objects }, () => new Float64Array(motions.length));
  const [uplift, shock] = [empty(), empty()];
  const [lifted, fallen, ceiling] = [new Uint16Array(objects), new Uint16Array(objects), new Float64Array(objects)];
  for (let row = 0; row < rows.outcome.length; row += 1) {
    const [motion, object] = [Math.floor(row / objects), row % objects];
    const outcome = rows.outcome[row]!;
    const falls = hasFallen(outcome);
    uplift[object]![motion] = falls ? Infinity : (rows.uplift_m[row] ?? NaN);
    shock[object]![motion] = falls ? Infinity : (rows.edge_acceleration_g?.[row] ?? NaN);
    ceiling[object] = rows.ceiling_g?.[row] ?? NaN;
    if (falls) fallen[object]! += 1;
    if (falls || (rows.uplift_m[row] ?? 0) > 0) lifted[object]! += 1;
  }
  const ordered = (values: Float64Array) => values.filter((value) => !Number.isNaN(value)).sort();
  return { motions, heights, thicknesses, uplift, shock, sorted: { uplift: uplift.map(ordered), shock: shock.map(ordered) }, ceiling, lifted, fallen };
}

/**
 * The quantile of sorted values, by linear interpolation between the ranks (n − 1)q (Hyndman and Fan 1996, type 7), as the
 * program's `ranked_quantile`: infinite, falling, where the interpolation needs a motion that overturns the object.
 */
export function quantile(sorted: ArrayLike<number>, q: number): number {
  const last = sorted.length - 1;
  if (last < 0) return NaN;
  const position = q * last;
  const below = Math.floor(position);
  const share = position - below;
  const lower = sorted[below]!;
  return share === 0 || lower === Infinity ? lower : lower + share * (sorted[Math.min(below + 1, last)]! - lower);
}

/** What lies under an edge. */
export interface Resting { mass_kg: number; stiffness_n_m: number }

/**
 * The shock for another mass and stiffness over the shock for the first ones. By Eq. (5) of Al Abadi et al. an edge that
 * lands at v on a spring has the peak v √(k/m_eff), where v and m_eff/m depend on the shape alone.
 */
export function shockRatio(from: Resting, to: Resting): number {
  return Math.sqrt((to.stiffness_n_m / from.stiffness_n_m) * (from.mass_kg / to.mass_kg));
}

/** The value of every object that the map shows: metres of uplift, or g of shock. */
export function shownValues(cells: Field, quantity: Quantity, q: number, ratio: number): Float64Array {
  const factor = quantity === 'shock' ? ratio : 1;
  return Float64Array.from(cells.sorted[quantity], (sorted) => quantile(sorted, q) * factor);
}

/** The number of steps of the ramp; the last one is open. */
export const STEPS = 7;

/** A round width of a step, 1, 2 or 5 times a power of ten, so that the ramp covers all but the largest fiftieth. */
export function stepWidth(values: ArrayLike<number>): number {
  const known = Float64Array.from(Array.from(values).filter((value) => Number.isFinite(value) && value > 0)).sort();
  const most = quantile(known, 0.98) / (STEPS - 1);
  if (!(most > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(most));
  return [1, 2, 5, 10].map((one) => one * power).find((one) => one >= most * 0.999) ?? 10 * power;
}

/** Which step of the ramp a value has; −1 where nothing moves. */
export function stepOf(value: number, width: number): number {
  return value > 0 ? Math.min(STEPS - 1, Math.floor(value / width)) : -1;
}

/** The index of the value that is nearest. */
export function nearest(values: number[], wanted: number): number {
  return values.reduce((best, value, i) => (Math.abs(value - wanted) < Math.abs(values[best]! - wanted) ? i : best), 0);
}

/** The motion that tells most about an object: the first that overturns it, else the one that lifts it most. */
export function tellingMotion(uplift: ArrayLike<number>): number {
  let best = 0;
  for (let i = 1; i < uplift.length; i += 1) if (uplift[i]! > uplift[best]! || Number.isNaN(uplift[best]!)) best = i;
  return best;
}

/** A number of a logarithmic slider, with three digits. */
export function ofSlider(exponent: number): number {
  return Number((10 ** exponent).toPrecision(3));
}
