import { expect, it } from 'vitest';
import { decimals, spaced } from './table';

it('shows the first and the last row, and no row twice', () => {
  expect(spaced(3, 200)).toEqual([0, 1, 2]);
  expect(spaced(0, 200)).toEqual([]);
  for (const count of [201, 399, 10_000]) {
    const rows = spaced(count, 200);
    expect([rows[0], rows.at(-1), rows.length, new Set(rows).size]).toEqual([0, count - 1, 200, 200]);
  }
});

it('writes a column with the digits of its largest value', () => {
  expect(decimals([1e-7, -0.102, 0.05], 4)).toBe(4);
  expect([decimals([0, 24], 5), decimals([1300, 4], 4), decimals([], 4), decimals([0, NaN], 4)]).toEqual([3, 0, 0, 0]);
});
