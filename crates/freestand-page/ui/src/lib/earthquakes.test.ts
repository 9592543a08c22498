import { expect, it } from 'vitest';
import type { Earthquake } from './documents';
import { effect, gentlestFirst, titleOf } from './earthquakes';
import type { History } from './history';

it('never tells an uplift of 0 mm', () => {
  const one = (uplift_m: number | null): Earthquake => ({ name: 'a', outcome: 'rocked', uplift_m, landing_acceleration_g: null });
  const history = { outcome: 'rocked', time_s: [0, 1], theta_rad: [0, 0], base_time_s: [0, 1], base_accel_m_s2: [0, 0], impacts: [], tolerance_rad: 0 } as unknown as History;
  for (const [uplift, shown] of [[null, '< 1 mm'], [0, '< 1 mm'], [4e-4, '< 1 mm'], [0.0123, '12 mm']] as const) {
    expect(effect(one(uplift), 'si')).toBe(shown);
    expect(titleOf([one(uplift)], 'a', history, 'si')).toMatch(new RegExp(`lifted by ${shown}$`));
  }
});

const landed = (name: string, outcome: string, landing: number | null): Earthquake => ({ name, outcome, uplift_m: 0.01, landing_acceleration_g: landing });

it('goes from the gentlest to the hardest, and a fall is the hardest', () => {
  const all = [landed('a', 'rocked', 0.4), landed('b', 'rocked', 14), landed('c', 'overturned', null), landed('d', 'rocked', 6.4), landed('e', 'no-uplift', null)];
  expect(gentlestFirst(all).map((one) => one.name)).toEqual(['e', 'a', 'd', 'b', 'c']);
});

it('does not say that no edge lifts where one lands', () => {
  const history = {
    outcome: 'no-uplift', time_s: [0, 1], theta_rad: [0, 1e-4], base_time_s: [0, 1], base_accel_m_s2: [0, 0], base_width_m: 0.4,
    impacts: [{ time_s: 1, edge_acceleration_g: 0.1, edge: 'left' }],
  } as unknown as History;
  expect(titleOf([landed('a', 'no-uplift', null)], 'a', history, 'si')).toMatch(/lifted by < 1 mm$/);
});
