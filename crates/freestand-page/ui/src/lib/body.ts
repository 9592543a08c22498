/** A body in three dimensions: its triangles as the program understood them, and where it is. */
import { surfaceBytes, type Ask } from './api';
import { along, valueAt, type History, type Space } from './history';

export interface Surface {
  /** x, y, z of each vertex [m]. */
  places: Float32Array<ArrayBuffer>;
  /** The numbers of the vertices of each triangle. */
  corners: Uint32Array<ArrayBuffer>;
}

/** The triangles of the program: how many vertices and triangles there are, the vertices, the triangles. */
export function readSurface(bytes: ArrayBuffer): Surface {
  const [vertices, triangles] = new Uint32Array(bytes, 0, 2) as unknown as [number, number];
  return { places: new Float32Array(bytes, 8, 3 * vertices), corners: new Uint32Array(bytes, 8 + 12 * vertices, 3 * triangles) };
}

let last: { key: string; surface: Promise<Surface> } | null = null;

/** The options that say what an object looks like, besides those of a scan. */
const OF_SHAPE: readonly string[] = ['height', 'diameter', 'cg-height', 'mass'];

/** Whether a question is about a body in three dimensions. */
export const isOfBody = ({ options, files }: Ask) => 'diameter' in options || files?.['scan'] !== undefined;

/** The surface of the object of a question. Its earthquake changes nothing, so the last one is kept. */
export function surfaceOf({ command, options, files }: Ask): Promise<Surface> {
  const shape = Object.entries(options).filter(([name]) => OF_SHAPE.includes(name) || name.startsWith('scan'));
  const key = JSON.stringify([shape, files?.['scan']]);
  if (last?.key !== key) {
    const surface = surfaceBytes({ command, options, ...(files ? { files } : {}) }).then(readSurface);
    last = { key, surface };
    // What failed is asked again.
    surface.catch(() => { last = null; });
  }
  return last.surface;
}

/** Where a body is: its place [m] and its rotation (w, x, y, z). */
export interface Pose { place: [number, number, number]; turn: [number, number, number, number] }

/** Puts the pose at a time into `pose`: nothing is made anew for each frame. */
export function poseAt(history: History, space: Space, time: number, pose: Pose): void {
  const place = along(history.time_s, time);
  for (let i = 0; i < 3; i += 1) pose.place[i] = valueAt(space.place_m[i]!, place);
  for (let i = 0; i < 4; i += 1) pose.turn[i] = valueAt(space.turn[i]!, place);
  const size = Math.hypot(...pose.turn);
  for (let i = 0; i < 4; i += 1) pose.turn[i] = pose.turn[i]! / size;
}

export const noPose = (): Pose => ({ place: [0, 0, 0], turn: [1, 0, 0, 0] });

/** The rows of the matrix of a rotation. */
function rows([w, x, y, z]: Pose['turn']): number[][] {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

/** The outline of a body from the side: how far along a direction of the floor and how high [m], anticlockwise (Andrew 1979). */
export function silhouette({ places }: Surface, { scale_ratio: scale, shift_m: shift }: Space, { place, turn }: Pose, toward_rad: number): [number, number][] {
  const [x, y, z] = rows(turn) as [number[], number[], number[]];
  const [cos, sin] = [Math.cos(toward_rad), Math.sin(toward_rad)];
  const right = x.map((one, i) => cos * one + sin * y[i]!);
  const middle = cos * place[0] + sin * place[1];
  const points: [number, number][] = [];
  for (let i = 0; i < places.length; i += 3) {
    let [u, v] = [middle, place[2]];
    for (let k = 0; k < 3; k += 1) {
      const p = shift[k]! + scale[k]! * places[i + k]!;
      u += right[k]! * p;
      v += z[k]! * p;
    }
    points.push([u, v]);
  }
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const around: [number, number][] = [];
  for (let half = 0; half < 2; half += 1) {
    const start = around.length;
    for (const point of points) {
      for (;;) {
        const [a, b] = [around.at(-2), around.at(-1)];
        if (around.length < start + 2 || (b![0] - a![0]) * (point[1] - a![1]) > (b![1] - a![1]) * (point[0] - a![0])) break;
        around.pop();
      }
      around.push(point);
    }
    // It is the first one of the other half.
    around.pop();
    points.reverse();
  }
  return around;
}

/** How far a surface reaches from the centre of gravity of its body [m]. */
export function reach({ places }: Surface): number {
  let most = 0;
  for (let i = 0; i < places.length; i += 3) most = Math.max(most, Math.hypot(places[i]!, places[i + 1]!, places[i + 2]!));
  return most;
}

/** Vertices that stand for those of a cell, and the triangles whose corners are in three cells. */
function clustered({ places, corners }: Surface, cell_m: number): Surface {
  const numbers = new Map<string, number>();
  const sums: number[] = [];
  const cellOf = new Uint32Array(places.length / 3);
  for (let vertex = 0; vertex < cellOf.length; vertex += 1) {
    const point = places.subarray(3 * vertex, 3 * vertex + 3);
    const key = point.reduce((all, one) => `${all} ${Math.floor(one / cell_m)}`, '');
    const number = numbers.get(key) ?? numbers.size;
    if (number === numbers.size) {
      numbers.set(key, number);
      sums.push(0, 0, 0, 0);
    }
    for (let k = 0; k < 3; k += 1) sums[4 * number + k]! += point[k]!;
    sums[4 * number + 3]! += 1;
    cellOf[vertex] = number;
  }
  const kept: number[] = [];
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [cellOf[corners[i]!]!, cellOf[corners[i + 1]!]!, cellOf[corners[i + 2]!]!];
    if (a !== b && b !== c && c !== a) kept.push(a, b, c);
  }
  const middles = Float32Array.from({ length: 3 * numbers.size }, (_, i) => sums[4 * Math.floor(i / 3) + (i % 3)]! / sums[4 * Math.floor(i / 3) + 3]!);
  return { places: middles, corners: Uint32Array.from(kept) };
}

/** A surface of at most this many triangles that looks much the same: vertices of a cell become one (Rossignac and Borrel 1993). */
export function coarser(surface: Surface, most: number): Surface {
  let coarse = surface;
  for (let cell_m = reach(surface) / 100; coarse.corners.length > 3 * most; cell_m *= 1.25) coarse = clustered(surface, cell_m);
  return coarse;
}
