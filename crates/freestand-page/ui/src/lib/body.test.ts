import { describe, expect, it } from 'vitest';
import { coarser, noPose, poseAt, reach, readSurface, silhouette, type Surface } from './body';
import { busy, stills, telling, type History, type Space } from './history';

const HALF = Math.SQRT1_2;

/** A box of 0.2 m × 0.4 m × 1 m about its middle, and its history: it stands, then it has turned by a right angle about y. */
const corners = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].flatMap((z) => [0.1 * x, 0.2 * y, 0.5 * z])));
const box: Surface = { places: Float32Array.from(corners), corners: new Uint32Array(0) };
const space: Space = {
  place_m: [[0, 0.2, 0.4], [0, 0, 0], [0.5, 0.5, 0.1]], turn: [[1, 1, HALF], [0, 0, 0], [0, 0, HALF], [0, 0, 0]],
  scale_ratio: [1, 1, 1], shift_m: [0, 0, 0], base_accel_y_m_s2: [], weakest_rad: 0, tolerance_m: 1e-4,
};
const history = (outcome: string, theta_rad = [0, 0, Math.PI / 2], time_s = [0, 1, 2]): History => ({
  time_s, theta_rad, base_time_s: [], base_accel_m_s2: [], impacts: [], tolerance_rad: 0, outcome, base: 'stiff',
  height_m: 1, thickness_m: 0.2, base_width_m: 0.2, cg_height_m: 0.5, balance_rad: 0.2, wall_left: null, wall_right: null, space,
});

/** How far an outline reaches: left, right, down, up. */
const bounds = (points: [number, number][]) => [0, 1].flatMap((axis) => [Math.min(...points.map((one) => one[axis]!)), Math.max(...points.map((one) => one[axis]!))]);

describe('a body', () => {
  it('is read as the program writes it', () => {
    const bytes = new ArrayBuffer(8 + 4 * (9 + 3));
    new Uint32Array(bytes, 0, 2).set([3, 1]);
    new Float32Array(bytes, 8, 9).set([0, 0, 0, 1, 0, 0, 0, 2, 0]);
    new Uint32Array(bytes, 44, 3).set([0, 1, 2]);
    const surface = readSurface(bytes);
    expect([...surface.places]).toEqual([0, 0, 0, 1, 0, 0, 0, 2, 0]);
    expect([...surface.corners]).toEqual([0, 1, 2]);
    expect(reach(surface)).toBe(2);
    // A file that ends too early is no surface.
    expect(() => readSurface(bytes.slice(0, 40))).toThrow();
  });

  it('is between its points, and its rotation stays one', () => {
    const pose = noPose();
    poseAt(history('overturned'), space, 0.5, pose);
    expect(pose.place).toEqual([0.1, 0, 0.5]);
    poseAt(history('overturned'), space, 1.5, pose);
    expect(Math.hypot(...pose.turn)).toBeCloseTo(1, 12);
    // Half of a right angle.
    expect(2 * Math.atan2(pose.turn[2], pose.turn[0])).toBeCloseTo(Math.PI / 4, 12);
    poseAt(history('overturned'), space, 9, pose);
    expect(pose.place).toEqual([0.4, 0, 0.1]);
  });

  it('has an outline from each side', () => {
    const pose = noPose();
    poseAt(history('stood'), space, 0, pose);
    const seen = (toward: number, of = space) => bounds(silhouette(box, of, pose, toward)).map((one) => Number(one.toFixed(6)) + 0);
    expect(seen(0)).toEqual([-0.1, 0.1, 0, 1]);
    expect(seen(Math.PI / 2)).toEqual([-0.2, 0.2, 0, 1]);
    expect(silhouette(box, space, pose, 0).length).toBe(4);
    expect(seen(0, { ...space, scale_ratio: [2, 1, 1], shift_m: [0, 0, 0.01] })).toEqual([-0.2, 0.2, 0.01, 1.01]);
    // Turned about y, what was up points to +x.
    poseAt(history('overturned'), space, 2, pose);
    expect(seen(0)).toEqual([-0.1, 0.9, 0, 0.2]);
  });

  it('is past its balance only where it falls, and its tilt is never quite 0', () => {
    const tilts = [0, 1e-5, 0.21, 1e-5, 0.1, 1e-5];
    const times = [0, 10, 11, 12, 13, 20];
    const stands = history('rocked', tilts, times);
    expect(stills(stands).map((one) => one.moment)).not.toContain('past');
    expect(stills(stands).at(-1)!.moment).toBe('end');
    expect(busy(stands)).toEqual({ from: 9, to: 20 });
    expect(telling(stands)).toBe(11);
    const falls = history('overturned', [0, 0.1, 0.21, 1.05], [0, 1, 2, 3]);
    expect(stills(falls).map((one) => one.moment).slice(-2)).toEqual(['past', 'falls']);
    expect(stills(history('shifted', [0, 0.1, 0.21, 0.15], [0, 1, 2, 3])).at(-1)!.moment).toBe('end');
  });

  it('is drawn with fewer triangles of the same extent', () => {
    // A cylinder of 2 x 60 x 40 triangles, 1 m high, with a radius of 0.1 m.
    const [rings, around] = [40, 60];
    const places = Float32Array.from({ length: 3 * (rings + 1) * around }, (_, i) => {
      const [up, turn] = [Math.floor(i / 3 / around) / rings, (2 * Math.PI * (Math.floor(i / 3) % around)) / around];
      return [0.1 * Math.cos(turn), 0.1 * Math.sin(turn), up - 0.5][i % 3]!;
    });
    const triangles = Array.from({ length: rings * around }, (_, i) => {
      const [a, b] = [i, i - (i % around) + ((i + 1) % around)];
      return [a, b, b + around, a, b + around, a + around];
    });
    const fine: Surface = { places, corners: Uint32Array.from(triangles.flat()) };
    const coarse = coarser(fine, 1000);
    expect(coarse.corners.length / 3).toBeLessThanOrEqual(1000);
    expect(coarse.corners.length / 3).toBeGreaterThan(300);
    expect(Math.max(...coarse.corners)).toBeLessThan(coarse.places.length / 3);
    // The middle of a cell is at most a cell from the vertices that it stands for; a cell is at most a tenth of the reach here.
    expect(Math.abs(reach(coarse) - reach(fine))).toBeLessThan(0.05);
    expect(coarser(fine, 4800)).toBe(fine);
  });
});
