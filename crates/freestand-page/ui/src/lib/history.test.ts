import { describe, expect, it } from 'vitest';
import { at, busy, flashes, floorMoves, stills, telling, type History, type Impact } from './history';

const impact = (time_s: number, g: number): Impact => ({ time_s, edge_acceleration_g: g, edge: 'left' });
const history = (time_s: number[], theta_rad: number[]): History => ({
  time_s, theta_rad, base_time_s: [], base_accel_m_s2: [], impacts: [], tolerance_rad: 0, outcome: 'rocked', base: 'rigid',
  height_m: 1.8, thickness_m: 0.4, base_width_m: 0.4, cg_height_m: 0.9, balance_rad: 0.2, wall_left: null, wall_right: null,
});

describe('a history', () => {
  it('is linear between its points and stays at its ends', () => {
    const [times, values] = [[0, 1, 3], [0, 2, -2]];
    expect([-1, 0.5, 2, 3, 9].map((time) => at(times, values, time))).toEqual([0, 1, 0, -2, -2]);
    expect(at([], [], 1)).toBe(0);
  });

  it('flashes for strong impacts three times a second of the watcher at most', () => {
    const strong = Array.from({ length: 40 }, (_, i) => impact(i * 0.1, 5));
    const shown = flashes(strong, 1).map((one) => one.time_s);
    for (const time of shown) expect(shown.filter((other) => other > time - 1 && other <= time).length).toBeLessThanOrEqual(3);
    expect(shown.length).toBeGreaterThanOrEqual(9);
    // Four times slower, the same second has fewer impacts.
    expect(flashes(strong, 0.25).length).toBeGreaterThan(shown.length);
    expect(flashes([impact(0, 0.01), impact(1, 2), { ...impact(2, 0), edge_acceleration_g: null }], 1).length).toBe(1);
  });

  it('is first seen at its largest tilt, or on its way down', () => {
    expect(telling(history([0, 1, 2, 3], [0, 0.1, -0.15, 0]))).toBe(2);
    expect(telling(history([0, 1, 2, 3], [0, 0.1, 0.17, 1.57]))).toBe(2);
  });

  it('has five stills in the order of time', () => {
    const times = Array.from({ length: 200 }, (_, i) => i * 0.05);
    const found = stills(history(times, times.map((time) => 0.1 * Math.sin(3 * time) * Math.exp(-0.2 * time))));
    expect(found.length).toBe(5);
    expect(found.map((one) => one.time)).toEqual([...found.map((one) => one.time)].sort((a, b) => a - b));
    expect(found.map((one) => one.moment)).toContain('largest');
    expect(stills(history([0, 1], [0, 0])).length).toBe(5);
  });
});

it('names its stills by what they show', () => {
  const moments = (one: History) => stills(one).map(({ moment }) => moment);
  // Nothing lifts: all of them show an object at rest.
  expect(moments(history([0, 5, 10], [0, 0, 0]))).toEqual(['rest', 'rest', 'rest', 'rest', 'end']);
  expect(moments(history([0, 4, 5, 6], [0, 0, 0.3, 1.57])).at(-1)).toBe('lies');
});

it('plays where something is to be seen', () => {
  expect(busy(history([0, 20, 21, 22, 60], [0, 0, 0.1, 0, 0]))).toEqual({ from: 19, to: 22.5 });
  expect(busy(history([0, 60], [0, 0]))).toEqual({ from: 0, to: 60 });
});

it('moves its floor about its place', () => {
  const time = Array.from({ length: 2001 }, (_, i) => i * 0.01);
  const wave = { ...history([0, 20], [0, 0]), base_time_s: time, base_accel_m_s2: time.map((one) => Math.sin(2 * Math.PI * 2 * one)) };
  // A wave of 1 m/s² and 2 Hz moves 1/(2π·2)² = 6.3 mm to each side; what is left out below 1/3 Hz takes a few percent of it.
  const late = floorMoves(wave).slice(1000);
  const most = late.reduce((all, one) => Math.max(all, Math.abs(one)), 0);
  expect(most).toBeGreaterThan(0.9 * 6.33e-3);
  expect(most).toBeLessThan(1.1 * 6.33e-3);
});
