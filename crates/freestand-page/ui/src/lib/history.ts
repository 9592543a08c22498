/** The history of an object as the program gives it, and what the animation needs of it. */

export interface Impact { time_s: number; edge_acceleration_g: number | null; edge: 'left' | 'right' }

export interface History {
  time_s: number[];
  theta_rad: number[];
  base_time_s: number[];
  base_accel_m_s2: number[];
  impacts: Impact[];
  tolerance_rad: number;
  outcome: string;
  base: 'rigid' | 'compliant' | 'stiff';
  height_m: number;
  thickness_m: number;
  base_width_m: number;
  cg_height_m: number;
  balance_rad: number;
  wall_left: Wall | null;
  wall_right: Wall | null;
  /** Where a body in three dimensions is; its θ is its tilt in any direction. */
  space?: Space;
}

/** A point p of the surface of a body is at place + Q (shift + scale p), in the axes of the floor, z upward [m]. */
export interface Space {
  place_m: [number[], number[], number[]];
  /** Q: w, x, y, z of a quaternion. */
  turn: [number[], number[], number[], number[]];
  scale_ratio: [number, number, number];
  shift_m: [number, number, number];
  base_accel_y_m_s2: number[];
  /** Where its weakest side is at rest; null: it is round. */
  weakest_rad: number | null;
  tolerance_m: number;
}

/** A wall beside the object; without a height it is taller than the object. */
export interface Wall { gap_m: number; height_m: number | null }

/** Between which points a time is: the number of the first one and the share of the way to the next, together; within their ends. */
export function along(times: number[], time: number): number {
  const last = times.length - 1;
  if (last < 0 || time <= times[0]!) return 0;
  if (time >= times[last]!) return last;
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  return low + (time - times[low]!) / (times[high]! - times[low]!);
}

/** A value at such a place. */
export function valueAt(values: number[], place: number): number {
  const first = Math.floor(place);
  const from = values[first] ?? 0;
  return from + ((values[first + 1] ?? from) - from) * (place - first);
}

/** The value at a time of what is linear between its points; the last one after the end. */
export const at = (times: number[], values: number[], time: number) => valueAt(values, along(times, time));

export const tilt = (history: History, time: number) => at(history.time_s, history.theta_rad, time);
export const floor = (history: History, time: number) => at(history.base_time_s, history.base_accel_m_s2, time);
export const end = (history: History) => history.time_s.at(-1) ?? 0;

/** Above this, a flash could disturb who is sensitive to flashes. */
const STRONG_G = 3;
const STRONG_A_SECOND = 3;
/** Below this nothing is seen. */
const FAINT_G = 0.05;

/**
 * The impacts that flash while the animation runs at a speed: all that are not faint, but of the strong ones
 * at most three in any second of the watcher (WCAG 2.3.1).
 */
export function flashes(impacts: Impact[], speed: number): Impact[] {
  const strong: number[] = [];
  return impacts.filter(({ time_s, edge_acceleration_g }) => {
    const g = edge_acceleration_g ?? 0;
    if (g < FAINT_G) return false;
    if (g <= STRONG_G) return true;
    const seen = time_s / speed;
    if (strong.filter((other) => seen - other <= 1).length >= STRONG_A_SECOND) return false;
    strong.push(seen);
    return true;
  });
}

/** Below this nothing is seen to turn [rad]; a body on elastic contacts is never quite still. */
const STILL_RAD = 1e-6;
const STILL_BODY_RAD = 5e-4;
const stillness = ({ space }: History) => (space ? STILL_BODY_RAD : STILL_RAD);

/** Whether an object can only fall at this point; the tilt of a body says so only where the program does. */
const isPast = ({ space, outcome, balance_rad }: History, theta: number) => Math.abs(theta) >= balance_rad && (!space || outcome === 'overturned' || outcome === 'leaned' || outcome === 'shifted');

/** Where an object is to be seen first: at its largest tilt, or on its way down. */
export function telling(history: History): number {
  const { time_s, theta_rad } = history;
  const falls = theta_rad.findIndex((theta) => isPast(history, theta / 0.8));
  if (falls >= 0) return time_s[falls]!;
  let most = 0;
  theta_rad.forEach((theta, i) => {
    if (Math.abs(theta) > Math.abs(theta_rad[most]!)) most = i;
  });
  return time_s[most] ?? 0;
}

export type Moment = 'lift' | 'swing' | 'past' | 'largest' | 'end' | 'lies' | 'falls' | 'rest' | 'between';

/** Five moments that tell the story: lift, two swings, the moment past balance or the largest tilt, the end. Each has the name of what is seen. */
export function stills(history: History): { time: number; moment: Moment }[] {
  const { time_s, theta_rad } = history;
  const last = end(history);
  const still = stillness(history);
  const lift = time_s.find((_, i) => Math.abs(theta_rad[i + 1] ?? 0) > still) ?? 0;
  const past = theta_rad.findIndex((theta) => isPast(history, theta));
  // The history of a body ends while it falls.
  const after: Moment = past < 0 || history.outcome === 'shifted' ? 'end' : history.space ? 'falls' : 'lies';
  const until = past >= 0 ? time_s[past]! : last;
  const peaks = time_s
    .map((time, i) => ({ time, size: Math.abs(theta_rad[i]!), i }))
    .filter(({ time, size, i }) =>
      time > lift && time < until && size > 0 &&
      size >= Math.abs(theta_rad[i - 1] ?? 0) && size >= Math.abs(theta_rad[i + 1] ?? 0))
    .sort((a, b) => b.size - a.size);
  const [largest, ...others] = peaks;
  const hasLifted = theta_rad.some((theta) => Math.abs(theta) > still);
  const found: { time: number; moment: Moment }[] = [{ time: lift, moment: hasLifted ? 'lift' : 'rest' }, { time: last, moment: after }];
  if (past >= 0) found.push({ time: until, moment: 'past' });
  else if (largest) found.push({ time: largest.time, moment: 'largest' });
  const swings = past >= 0 ? peaks : others;
  // Swings of one lift look alike: they are to be apart.
  const gap = Math.max(0.2, 0.03 * last);
  for (const { time } of swings) {
    if (found.length >= 5) break;
    if (found.every((other) => Math.abs(other.time - time) >= gap)) found.push({ time, moment: 'swing' });
  }
  // Where there are fewer swings, moments between are shown as what they are.
  for (let i = 1; found.length < 5 && i < 5; i += 1) {
    const time = lift + ((last - lift) * i) / 5;
    found.push({ time, moment: Math.abs(tilt(history, time)) > still ? 'between' : 'rest' });
  }
  return found.sort((a, b) => a.time - b.time);
}

/** The times between which something is to be seen: a little before the first uplift to a little after the last; all of it where nothing lifts. */
export function busy(history: History): { from: number; to: number } {
  const { time_s, theta_rad } = history;
  const last = end(history);
  const still = stillness(history);
  const first = theta_rad.findIndex((theta) => Math.abs(theta) > still);
  if (first < 0) return { from: 0, to: last };
  const after = theta_rad.findLastIndex((theta) => Math.abs(theta) > still);
  return { from: Math.max(0, (time_s[Math.max(0, first - 1)] ?? 0) - BEFORE_S), to: Math.min(last, (time_s[Math.min(after + 1, time_s.length - 1)] ?? last) + AFTER_S) };
}

/** How long the floor is seen to shake before the object lifts, and after it rests [s]. */
const [BEFORE_S, AFTER_S] = [1, 0.5] as const;

/**
 * Where the floor is at each of its samples [m], for the drawing: its acceleration integrated twice, without what is slower
 * than a few seconds, so that it moves about its place.
 */
export function floorMoves({ base_time_s: time, base_accel_m_s2: accel }: Pick<History, 'base_time_s' | 'base_accel_m_s2'>): number[] {
  const velocity = leaked(time, accel);
  return leaked(time, velocity);
}

/** Slower motions than this are not drawn [s]. */
const SLOW_S = 3;

/** The integral of a signal that forgets what is older than a few seconds. */
function leaked(time: number[], values: number[]): number[] {
  let sum = 0;
  return values.map((value, i) => {
    if (i === 0) return 0;
    const step = time[i]! - time[i - 1]!;
    sum = (sum + 0.5 * (value + values[i - 1]!) * step) * Math.exp((-2 * Math.PI * step) / SLOW_S);
    return sum;
  });
}

/** The largest uplift of an edge that a history shows, before it falls [m]. */
export const liftShown = ({ theta_rad, base_width_m }: History) => base_width_m * Math.sin(theta_rad.reduce((all, theta) => Math.max(all, Math.abs(theta)), 0));

export const degrees = (rad: number) => (rad * 180) / Math.PI;
