import { expect, it } from 'vitest';
import type { Earthquake } from './documents';
import { effect, titleOf } from './earthquakes';
import type { History } from './history';

it('never tells an uplift of 0 mm', () => {
  const one = (uplift_m: number | null): Earthquake => ({ name: 'a', outcome: 'rocked', uplift_m, landing_acceleration_g: null });
  const history = { outcome: 'rocked', time_s: [0, 1], theta_rad: [0, 0], base_time_s: [0, 1], base_accel_m_s2: [0, 0], impacts: [], tolerance_rad: 0 } as unknown as History;
  for (const [uplift, shown] of [[null, '< 1 mm'], [0, '< 1 mm'], [4e-4, '< 1 mm'], [0.0123, '12 mm']] as const) {
    expect(effect(one(uplift), 'si')).toBe(shown);
    expect(titleOf([one(uplift)], 'a', history, 'si')).toMatch(new RegExp(`lifted by ${shown}$`));
  }
});
