import { describe, expect, it } from 'vitest';
import { distanceShown, forceShown, gShown, inUnits, lengthShown, lengthText, massShown, percent, stiffnessShown } from './units';

describe('lengths', () => {
  it('are written as one types them', () => {
    expect([1.8, 0.4, 0.9999, 0].map((one) => lengthText(one, 'si'))).toEqual(['1.8 m', '400 mm', '999.9 mm', '0 mm']);
    expect([1.8, 0.4, 0.05].map((one) => lengthText(one, 'us'))).toEqual(['5\'10.87"', '1\'3.75"', '1.97"']);
  });

  it('are shown as people write them', () => {
    expect([1.8, 0.4, 0.0036, 0.00002, 0].map((one) => lengthShown(one, 'si'))).toEqual(['1.80 m', '400 mm', '3.6 mm', '< 1 mm', '0 mm']);
    expect([1.8, 0.0254, 0.0036, 0.0009, 0].map((one) => lengthShown(one, 'us'))).toEqual(['5′ 11″', '1″', '0.14″', '< 0.04″', '0″']);
    expect([distanceShown(1.68, 'si'), distanceShown(314, 'si'), distanceShown(16.09344, 'us')]).toEqual(['1.7 km', '314 km', '10 mi']);
    expect([massShown(150, 'si'), massShown(150, 'us')]).toEqual(['150 kg', '331 lb']);
  });
});

describe('masses and stiffnesses', () => {
  it('are shown in both units', () => {
    expect([stiffnessShown(4.38e6, 'si'), stiffnessShown(4.38e6, 'us')]).toEqual(['4380 N/mm', '25000 lb/in']);
    expect([inUnits(150, 'mass', 'us'), inUnits(150, 'mass', 'si'), inUnits(0.4, 'length', 'us')]).toEqual(['330.7 lb', '150 kg', '1\'3.75"']);
    expect([forceShown(950, 'si'), forceShown(2415, 'si'), forceShown(950, 'us')]).toEqual(['950 N', '2.42 kN', '214 lbf']);
    expect([inUnits(4.38e6, 'stiffness', 'us'), inUnits(2.94, 'acceleration', 'us')]).toEqual(['25010 lb/in', null]);
  });
});

describe('shares and accelerations', () => {
  it('have the digits of the program', () => {
    // 12.5 and 13.5 % are halves: the program writes 12 % and 14 %.
    expect([0, 0.125, 0.135, 0.35, 1, 0.0013, 0.5875, 0.095].map(percent)).toEqual(['0', '12', '14', '35', '100', '0.13', '59', '9.5']);
    expect([0, 0.0001, 0.1, 3, 12.34, 321].map((g) => gShown(g))).toEqual(['0 g', '< 0.001 g', '0.10 g', '3.0 g', '12 g', '321 g']);
  });
});
