import { describe, expect, it } from 'vitest';
import { field, nearest, ofSlider, quantile, shockRatio, shownValues, stepOf, stepWidth, tellingMotion, type SpectrumColumns } from './spectra';

/** Two motions of a grid of one height and three thicknesses. */
const rows: SpectrumColumns = {
  motion: ['a', 'a', 'a', 'b', 'b', 'b'],
  height_m: [2, 2, 2, 2, 2, 2],
  thickness_m: [0.3, 0.4, 0.5, 0.3, 0.4, 0.5],
  outcome: ['overturned', 'rocked', 'no-uplift', 'overturned', 'leaned', 'failed'],
  uplift_m: [0.3, 0.02, 0, 0.3, 0.3, null],
  edge_acceleration_g: [null, 2.5, 0, null, null, null],
  ceiling_g: [3, 5, 7, 3, 5, 7],
};

describe('a field', () => {
  it('has the motions of every object, with falling above every number', () => {
    const cells = field(rows);
    expect([cells.motions, cells.heights, cells.thicknesses]).toEqual([['a', 'b'], [2], [0.3, 0.4, 0.5]]);
    expect(cells.uplift.map((one) => [...one])).toEqual([[Infinity, Infinity], [0.02, Infinity], [0, NaN]]);
    expect([[...cells.fallen], [...cells.lifted]]).toEqual([[2, 1, 0], [2, 2, 0]]);
    expect([...shownValues(cells, 'shock', 0, 2)]).toEqual([Infinity, 5, 0]);
    // A history that failed counts neither way.
    expect([...shownValues(cells, 'uplift', 1, 2)]).toEqual([Infinity, Infinity, 0]);
  });

  it('has the quantiles of the program', () => {
    // The cases of `ranked_quantile`.
    const falls = [Infinity, Infinity, Infinity, Infinity];
    expect(quantile([0, 1, 2, 3, 4, Infinity, ...falls], 0.5)).toBe(Infinity);
    expect(quantile([0, 1, 2, 3, 4, Infinity, ...falls], 0.16)).toBeCloseTo(1.44, 12);
    expect([quantile([0, 1, 2, 3, 4, ...falls], 0.5), quantile([0, 1, 2, 3, 4, ...falls], 0.84)]).toEqual([4, Infinity]);
    expect([quantile([2.5], 0.84), quantile([], 0.5)]).toEqual([2.5, NaN]);
  });

  it('is shown in seven steps of a round width', () => {
    expect(stepWidth([0, 1, 2, 3, 6, Infinity, NaN])).toBe(1);
    expect([stepWidth([]), stepWidth([0, Infinity])]).toEqual([1, 1]);
    for (const most of [0.0013, 0.2, 7, 4800]) {
      const width = stepWidth([most]);
      expect(most / width).toBeLessThanOrEqual(6.01);
      expect(most / width).toBeGreaterThan(2);
    }
    expect([stepOf(0, 1), stepOf(0.5, 1), stepOf(3, 1), stepOf(99, 1), stepOf(NaN, 1)]).toEqual([-1, 0, 3, 6, -1]);
  });
});

describe('the shock', () => {
  it('follows the root of stiffness over mass', () => {
    const paper = { mass_kg: 150, stiffness_n_m: 4.38e6 };
    expect(shockRatio(paper, paper)).toBe(1);
    expect(shockRatio(paper, { mass_kg: 600, stiffness_n_m: 4.38e6 })).toBeCloseTo(0.5, 12);
    expect(shockRatio(paper, { mass_kg: 150, stiffness_n_m: 9 * 4.38e6 })).toBeCloseTo(3, 12);
  });
});

it('finds the cell and the motion that are meant', () => {
  expect([nearest([0.3, 0.4, 0.5], 0.44), nearest([1], 9)]).toEqual([1, 0]);
  expect([tellingMotion([0, 0.2, Infinity, Infinity]), tellingMotion([0, 0.3, 0.1]), tellingMotion([NaN, 0.1])]).toEqual([2, 1, 1]);
  expect([ofSlider(Math.log10(4380)), ofSlider(Math.log10(150)), ofSlider(2)]).toEqual([4380, 150, 100]);
});
